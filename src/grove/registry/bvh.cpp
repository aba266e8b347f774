#include "grove/registry/bvh_forms.h"
#include "grove/registry/bvh_options.h"
#include "grove/registry/families.h"

namespace grove {

BvhOptions::BvhOptions(const Spec& spec)
    : split(spec.value("split")),
      cost(spec.value("cost")),
      bounds(spec.value("bounds")),
      arity(std::stoi(spec.value("arity"))),
      widen(spec.value("widen")),
      optimize(spec.value("optimize")),
      leaf_size(static_cast<std::uint32_t>(spec.number("leaf-size"))),
      radius(static_cast<std::uint32_t>(spec.number("radius"))) {}

StructureFamily describe_bvh() {
  return {"bvh",
          "bounding volume hierarchy",
          {
              {"split",
               {"binned", "sweep", "spatial", "object-median", "spatial-median", "lbvh", "ploc"},
               0,
               0,
               0,
               "how a set is parted: surface-area heuristic over bins, over all object splits, or cutting primitives; equal counts; equal "
               "volumes; or joined along the Morton curve: by its bits, or nearest neighbours first"},
              {"cost", {"standard", "equation-2"}, 0, 0, 0, "the surface-area cost of a split: today's form, or the review's equation 2"},
              {"bounds",
               {"aabb", "obb", "sphere"},
               0,
               0,
               0,
               "the bounding volume: axis-aligned boxes, or the same hierarchy with oriented boxes or spheres fitted to its primitives"},
              {"arity", {"2", "4", "8"}, 0, 0, 0, "most children of an interior node"},
              {"widen",
               {"optimal", "greedy"},
               0,
               0,
               0,
               "arity above 2: collapse of a binary hierarchy at least cost, or multi-way split from the top"},
              {"optimize", {"none", "reinsertion"}, 0, 0, 0, "improvement of the built hierarchy: parallel reinsertion of subtrees"},
              {"leaf-size", {}, 1, 64, 8, "most primitives in a leaf; the cost model decides below it"},
              {"radius", {}, 1, 64, 8, "split=ploc: how many places along the Morton curve neighbours are looked for"},
          }};
}

std::unique_ptr<Accelerator> build_bvh(const Spec& spec, const GeometryPointer& geometry) {
  const BvhOptions options(spec);
  if (options.bounds == "obb") return build_bvh_obb(spec, geometry);
  if (options.bounds == "sphere") return build_bvh_sphere(spec, geometry);
  switch (options.arity) {
    case 4:
      return build_bvh4(spec, geometry);
    case 8:
      return build_bvh8(spec, geometry);
    default:
      return build_binary_bvh(spec, geometry);
  }
}

}  // namespace grove
