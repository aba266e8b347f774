#pragma once

#include <span>

#include "grove/build/octree/part_octants.h"

namespace grove {

/// The planes of an octree: through the middle of the cell, whatever is in it. Where the cell is no more than rounding across an axis it is not cut there.
class MiddlePlanes {
 public:
  struct Scratch {};

  [[nodiscard]] static OctantCut choose(const Box4& cell) {
    OctantCut cut{cell, cell.upper, 0};
    const Float4 middle = splat(0.5F) * cell.lower + splat(0.5F) * cell.upper;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(cell.lower[axis] < middle[axis] && middle[axis] < cell.upper[axis])) continue;
      cut.planes[axis] = middle[axis];
      cut.axes |= 1U << axis;
    }
    return cut;
  }
  [[nodiscard]] static OctantCut choose(const OctantSource& /*source*/, const Box4& cell, std::span<const std::uint32_t> /*ids*/,
                                        Scratch& /*scratch*/) {
    return choose(cell);
  }
};

}  // namespace grove
