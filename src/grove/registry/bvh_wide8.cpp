#include "grove/registry/bvh_binary.h"
#include "grove/registry/bvh_forms.h"
#include "grove/registry/hierarchy_accelerator.h"
#include "grove/traverse/wide_traversal.h"

namespace grove {

std::unique_ptr<Accelerator> build_bvh8(const Spec& spec, const GeometryPointer& geometry) {
  const BvhOptions options(spec);
  return std::visit(
      [&](const auto& set) {
        return make_hierarchy_accelerator<WideBvh<8>>(spec, set, [options](const auto& primitives) {
          return widen<8>(build_binary_hierarchy(primitives, options), collapse_settings(options));
        });
      },
      geometry);
}

}  // namespace grove
