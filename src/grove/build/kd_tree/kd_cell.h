#pragma once

#include <cstdint>

#include "grove/build/kd_tree/kd_plane.h"

namespace grove {

/// A cell on its way to become a node.
struct KdCell {
  Box4 box;
  std::uint32_t depth = 0;
  std::uint32_t bad_planes = 0;
  /// How many references the subtree may make.
  std::uint64_t capacity = 0;

  [[nodiscard]] KdCell child(int side, const KdPlane& plane, std::uint32_t bad_so_far, std::uint64_t child_capacity) const {
    return {child_box(box, side, plane.axis, plane.position), depth + 1, bad_so_far, child_capacity};
  }

  /// The lower (0) or upper (1) side of a box that a plane parts.
  [[nodiscard]] static Box4 child_box(Box4 box, int side, int axis, float position) {
    (side == 0 ? box.upper : box.lower)[axis] = position;
    return box;
  }
};

}  // namespace grove
