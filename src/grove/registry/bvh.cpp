#include "grove/registry/bvh_forms.h"
#include "grove/registry/bvh_options.h"
#include "grove/registry/families.h"

namespace grove {

BvhOptions::BvhOptions(const Spec& spec)
    : split(spec.value("split")),
      cost(spec.value("cost")),
      bounds(spec.value("bounds")),
      arity(std::stoi(spec.value("arity"))),
      leaf_size(static_cast<std::uint32_t>(spec.number("leaf-size"))) {}

StructureFamily describe_bvh() {
  return {"bvh",
          "bounding volume hierarchy",
          {
              {"split",
               {"binned", "sweep", "spatial", "object-median", "spatial-median"},
               0,
               0,
               0,
               "how a set is parted: surface-area heuristic over bins, over all object splits, or cutting primitives; equal counts; equal "
               "volumes"},
              {"cost", {"standard", "equation-2"}, 0, 0, 0, "the surface-area cost of a split: today's form, or the review's equation 2"},
              {"bounds", {"aabb"}, 0, 0, 0, "the bounding volume: axis-aligned boxes"},
              {"arity", {"2"}, 0, 0, 0, "children of an interior node"},
              {"leaf-size", {}, 1, 64, 8, "most primitives in a leaf; the cost model decides below it"},
          }};
}

std::unique_ptr<Accelerator> build_bvh(const Spec& spec, const GeometryPointer& geometry) {
  return build_binary_bvh(spec, geometry);
}

}  // namespace grove
