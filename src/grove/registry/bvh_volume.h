#pragma once

#include "grove/accel/volume_bvh.h"
#include "grove/build/passes/rebound.h"
#include "grove/registry/bvh_binary.h"
#include "grove/registry/hierarchy_accelerator.h"
#include "grove/traverse/volume_traversal.h"

namespace grove {

/// The binary hierarchy that `spec` asks for, bound by volumes of one kind, with as many children a node as it says.
template <BoundingVolume V>
[[nodiscard]] std::unique_ptr<Accelerator> build_volume_bvh(const Spec& spec, const GeometryPointer& geometry) {
  const BvhOptions options(spec);
  return std::visit(
      [&](const auto& set) {
        return make_hierarchy_accelerator<VolumeBvh<V>>(spec, set, [options](const auto& primitives) {
          const Bvh2 bvh = build_binary_hierarchy(primitives, options);
          return rebound<V>(bvh, list_hulls(primitives, bvh.references), collapse_settings(options));
        });
      },
      geometry);
}

}  // namespace grove
