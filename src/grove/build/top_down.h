#pragma once

#include <cstdint>

#include "grove/accel/bvh2.h"
#include "grove/build/cost_model.h"
#include "grove/build/primitive_reference.h"

namespace grove {

/// The heuristics of the top-down builders that leave primitives whole (build/splits).
enum class ObjectSplit : std::uint8_t { binned, sweep, object_median, spatial_median };

struct TopDownSettings {
  ObjectSplit split = ObjectSplit::binned;
  /// Ranges of at most this many references may become leaves; they do where the cost model says so. At least 1.
  std::uint32_t leaf_size = 8;
  CostModel cost = {};
  /// No leaf is deeper. At least 40.
  std::uint32_t most_depth = Bvh2::kMaxDepth;
  /// Spatial splits only: how many references may be added, relative to the primitives.
  double duplication_budget = 1.0;
  /// Spatial splits only: they are tried where the overlap of the best object split has this share of the root's area (alpha in Stich et al. 2009).
  double least_overlap = 1e-5;
  /// Spatial splits only: and this share of the area of the range's own box.
  double least_overlap_of_range = 0.0;
};

/// Builds a binary hierarchy from the root down. The result is the same, bit for bit, for any number of threads. Where no split parts the
/// references, or the depth comes near its limit, ranges are halved, which bounds depth by Bvh2::kMaxDepth and time by
/// O(n log n) for any input (sweep: O(n log^2 n)). Peak memory: 68 bytes a reference and the hierarchy twice.
[[nodiscard]] Bvh2 build_top_down(ReferenceList list, const TopDownSettings& settings);

/// Marks places of Bvh2::references that hold none.
inline constexpr std::uint32_t kNoReference = 0xffffffffU;

/// Removes the places marked kNoReference and adapts the leaves. No leaf may contain one. O(nodes + references), parallel.
void close_reference_gaps(Bvh2& bvh);

}  // namespace grove
