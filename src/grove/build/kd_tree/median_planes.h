#pragma once

// The review's planes, which look at no cost: object median, with as many centres of boxes on one side as on the other, and spatial median, in the middle;
// both along the longest side of the cell that can be parted. What they cost is told, so that the driver knows where to stop.

#include <cstdint>
#include <vector>

#include "grove/build/kd_tree/reference_set.h"

namespace grove {

class MedianPlanes : public ReferenceFinder {
 public:
  enum class Of : std::uint8_t { objects, space };
  struct Scratch : PartScratch {
    std::vector<std::uint32_t> keys;  // of centres
  };

  MedianPlanes(Of of, const KdCostContext& costs, const ReferenceClipper& clipper) : ReferenceFinder(costs, clipper), of_(of) {}

  /// O(references).
  [[nodiscard]] KdPlane find(const ReferenceSet& set, const Box4& cell, Scratch& scratch) const;

 private:
  Of of_;
};

}  // namespace grove
