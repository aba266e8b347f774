#pragma once

// The top-down driver of binary hierarchies: it owns recursion, tasks, depth and memory; the split comes from build/splits.

#include <cstdint>

#include "grove/accel/bvh2.h"
#include "grove/build/cost_model.h"
#include "grove/build/primitive_reference.h"

namespace grove {

struct TopDownSettings {
  /// Ranges of at most this many references may become leaves; they do where the cost model says so. At least 1.
  std::uint32_t leaf_size = 8;
  CostModel cost;
};

/// Builds a binary hierarchy by binned surface-area splits. Large ranges are binned and partitioned in parallel in chunks of fixed size,
/// smaller ones become tasks of their own, so the result is the same, bit for bit, for any number of threads. Where no
/// split parts the centres, or the depth comes near its limit, ranges are halved, which bounds depth by Bvh2::kMaxDepth and time by
/// O(n log n) for any input. Peak memory: 68 bytes a reference and the hierarchy twice.
[[nodiscard]] Bvh2 build_binned(ReferenceList list, const TopDownSettings& settings);

}  // namespace grove
