#include "grove/registry/registry.h"

#include <utility>

#include "grove/registry/auto.h"
#include "grove/registry/families.h"

namespace grove {
namespace {

// The one list of structures: tests, command, lab and bindings go through it.
constexpr RegistryRow kRows[] = {
    {describe_brute, build_brute},     {describe_bvh, build_bvh},       {describe_fast, build_fast},
    {describe_kd_tree, build_kd_tree}, {describe_octree, build_octree}, {describe_auto, build_auto},
};

constexpr std::string_view kRepresentativeSpecs[] = {
    "brute",
    "bvh",
    "bvh:split=sweep",
    "bvh:split=spatial",
    "bvh:split=object-median",
    "bvh:split=spatial-median",
    "bvh:split=lbvh",
    "bvh:split=ploc",
    "bvh:bounds=obb",
    "bvh:bounds=sphere",
    "bvh:arity=4",
    "bvh:arity=8",
    "bvh:arity=8,widen=greedy",
    "bvh:optimize=reinsertion",
    "bvh:split=spatial,optimize=reinsertion",
    "fast",
    "fast:quality=low",
    "fast:quality=high",
    "kdtree",
    "kdtree:split=binned",
    "kdtree:split=object-median",
    "kdtree:split=spatial-median",
    "kdtree:walk=ropes",
    "octree",
    "octree:store=inner",
    "octree:walk=neighbour",
    "octree:split=octree-r",
    "octree:split=octree-r,planes=events",
    "octree:split=octree-r,planes=joint",
};

}  // namespace

std::span<const StructureFamily> structure_families() {
  static const std::vector<StructureFamily> families = [] {
    std::vector<StructureFamily> list;
    for (const RegistryRow& row : kRows) list.push_back(row.describe());
    return list;
  }();
  return families;
}

std::span<const std::string_view> representative_specs() {
  return kRepresentativeSpecs;
}

std::string canonical_spec(std::string_view spec) {
  return Spec::parse(spec).canonical();
}

bool rounds_hits(std::string_view spec) {
  const Spec parsed = Spec::parse(spec);
  return parsed.family().name == "fast" && parsed.value("triangles") == "fast";
}

std::unique_ptr<Accelerator> build(GeometryPointer geometry, std::string_view spec) {
  const Spec parsed = Spec::parse(spec);
  check_primitive_count(std::visit([](const auto& set) { return set->size(); }, geometry));
  const auto row = static_cast<std::size_t>(&parsed.family() - structure_families().data());
  return kRows[row].build(parsed, geometry);
}

std::unique_ptr<Accelerator> build(TriangleMesh mesh, std::string_view spec) {
  return build(std::make_shared<const TriangleMesh>(std::move(mesh)), spec);
}

}  // namespace grove
