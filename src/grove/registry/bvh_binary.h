#pragma once

// The binary hierarchy that all forms of the family `bvh` start from.

#include "grove/build/primitive_reference.h"
#include "grove/build/top_down.h"
#include "grove/registry/bvh_options.h"

namespace grove {

/// Builds the binary hierarchy over axis-aligned boxes that `options` ask for, before it is widened or bounded otherwise.
template <Geometry G>
[[nodiscard]] Bvh2 build_binary_hierarchy(const G& geometry, const BvhOptions& options) {
  TopDownSettings settings;
  settings.leaf_size = options.leaves_are_decided_later() ? 1 : options.leaf_size;
  return build_binned(list_references(geometry), settings);
}

}  // namespace grove
