#pragma once

// The review's planes, which look at no cost: object median, with as many primitives on one side as on the other (those that reach across counted on
// both), and spatial median, in the middle; both along the longest side of the cell that can be parted. What they cost is told, so that the driver knows
// where to stop. The object median is where half of the primitives' ends lie below: unlike a median of centres it does not cut primitives that
// end in one plane, which on a terrain halves the references.

#include <cstdint>
#include <vector>

#include "grove/build/kd_tree/reference_set.h"

namespace grove {

class MedianPlanes : public ReferenceFinder {
 public:
  enum class Of : std::uint8_t { objects, space };
  struct Scratch : PartScratch {
    std::vector<float> ends;
  };

  MedianPlanes(Of of, const KdCostContext& costs, const ReferenceClipper& clipper) : ReferenceFinder(costs, clipper), of_(of) {}

  /// O(references).
  [[nodiscard]] KdPlane find(const ReferenceSet& set, const Box4& cell, Scratch& scratch) const;

 private:
  Of of_;
};

}  // namespace grove
