#include "grove/registry/bvh_binary.h"

#include "grove/registry/bvh_forms.h"
#include "grove/registry/hierarchy_accelerator.h"
#include "grove/traverse/bvh2_traversal.h"

namespace grove {
namespace {

template <Geometry G>
std::unique_ptr<Accelerator> build_over(const Spec& spec, std::shared_ptr<const G> geometry) {
  const BvhOptions options(spec);
  const auto build = [options](const G& set) {
    Bvh2 bvh = build_binary_hierarchy(set, options);
    return options.leaves_are_decided_later() ? collapse_leaves(bvh, collapse_settings(options)) : bvh;
  };
  return make_hierarchy_accelerator<Bvh2>(spec, std::move(geometry), build, top_down_settings(options));
}

}  // namespace

std::unique_ptr<Accelerator> build_binary_bvh(const Spec& spec, const GeometryPointer& geometry) {
  return std::visit([&](const auto& set) { return build_over(spec, set); }, geometry);
}

}  // namespace grove
