#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "grove/accel/fast_node.h"
#include "grove/geometry/watertight_triangle.h"

namespace grove {

/// Where the planes of a node's children begin for rays of an octant, in planes: the near ones by axis, and the far ones. Octants are numbered as
/// a node's orders.
struct PlaneRows {
  std::uint32_t near[3];
  std::uint32_t octant;

  /// The lower planes of an axis and the upper ones are neighbours.
  [[nodiscard]] constexpr std::uint32_t far(int axis) const { return near[axis] ^ std::uint32_t{FastNode::kWidth}; }
};

inline constexpr auto kPlaneRows = [] {
  std::array<PlaneRows, 8> table{};
  for (std::uint32_t octant = 0; octant < 8; ++octant) {
    table[octant].octant = octant;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      table[octant].near[axis] = FastNode::kWidth * (2 * axis + (octant >> axis & 1U));
    }
  }
  return table;
}();

/// The axes of WatertightRay, by kz * 2 + whether the direction is negative along it.
struct RayAxes {
  std::uint32_t kx, ky, kz;
};
inline constexpr RayAxes kRayAxes[6] = {{1, 2, 0}, {2, 1, 0}, {2, 0, 1}, {0, 2, 1}, {0, 1, 2}, {1, 0, 2}};

/// A ray in flight. Set up by simd/ray_setup-inl.h, which says what the numbers are.
struct BatchRay {
  float inverse[3];
  float t_min;  ///< at least 0
  float near_offset[3];
  float depth_pad;  ///< how far a hit may be off the distances of its triangle's corners
  float far_offset[3];
  float inverse_z;  ///< 1 / direction[kz]
  /// Along kx, ky, kz: the origin negated, and the direction.
  float minus_origin_k[3];
  float shear_x;
  float direction_k[3];
  float shear_y;
  PlaneRows rows;
  RayAxes axes;
  const Ray* ray;

  /// Takes a ray's five parts of four numbers each, in the order above, and what tables have for its octant and kind of axes.
  void set(const float* const parts[5], std::uint32_t octant, std::uint32_t kind_of_axes, const Ray& of) {
    std::memcpy(inverse, parts[0], 4 * sizeof(float));
    std::memcpy(near_offset, parts[1], 4 * sizeof(float));
    std::memcpy(far_offset, parts[2], 4 * sizeof(float));
    std::memcpy(minus_origin_k, parts[3], 4 * sizeof(float));
    std::memcpy(direction_k, parts[4], 4 * sizeof(float));
    rows = kPlaneRows[octant];
    axes = kRayAxes[kind_of_axes];
    ray = &of;
  }

  /// For the test of single triangles.
  [[nodiscard]] WatertightRay triangle_ray() const {
    return {*ray, static_cast<int>(axes.kx), static_cast<int>(axes.ky), static_cast<int>(axes.kz), shear_x, shear_y};
  }
};

}  // namespace grove
