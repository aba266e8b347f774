#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "grove/accel/fast_bvh.h"
#include "grove/traverse/simd/batch_ray.h"

namespace grove {

/// Pairs of a ray and a triangle that it may hit, waiting to be tested side by side.
struct HitCandidates {
  static constexpr std::size_t kMost = 64;
  static constexpr std::size_t kGroup = 4;  ///< so many are tested at once

  /// Along the axes kx, ky, kz of the ray.
  alignas(64) float corner[3][3][kMost];
  /// Of the ray, as BatchRay has them: the origin negated and shear_x, the direction and shear_y.
  float minus_origin[kMost][4];
  float direction[kMost][4];
  float t_min[kMost];
  std::uint32_t primitive[kMost];
  /// Whose they are.
  std::uint8_t slot[kMost];
  std::uint8_t place[kMost];
  std::size_t count = 0;

  /// What the test finds: t, the primitive's bits, u and v.
  alignas(64) float hit[kMost][4];
  std::uint64_t valid;    ///< hits that are not before t_min, by bits
  std::uint64_t unknown;  ///< those that the test of single triangles must decide

  [[nodiscard]] bool is_full() const { return count == kMost; }

  void append(std::uint32_t slot_number, const BatchRay& ray, const TriangleBlock& block, std::uint32_t block_place) {
    const std::uint32_t axes[3] = {ray.axes.kx, ray.axes.ky, ray.axes.kz};
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < 3; ++i) corner[axis][i][count] = block.corners[axes[axis]][i][block_place];
    static_assert(offsetof(BatchRay, shear_x) == offsetof(BatchRay, minus_origin_k) + sizeof ray.minus_origin_k);
    static_assert(offsetof(BatchRay, shear_y) == offsetof(BatchRay, direction_k) + sizeof ray.direction_k);
    std::memcpy(minus_origin[count], ray.minus_origin_k, sizeof minus_origin[count]);
    std::memcpy(direction[count], ray.direction_k, sizeof direction[count]);
    t_min[count] = ray.t_min;
    primitive[count] = block.primitive[block_place];
    slot[count] = static_cast<std::uint8_t>(slot_number);
    place[count] = static_cast<std::uint8_t>(block_place);
    ++count;
  }

  /// Gives the last group numbers that mean nothing in its free lanes.
  void fill_up() {
    for (std::size_t i = count; i % kGroup != 0; ++i) {
      for (auto& by_corner : corner)
        for (auto& lanes : by_corner) lanes[i] = 0.0F;
      std::memset(minus_origin[i], 0, sizeof minus_origin[i]);
      std::memset(direction[i], 0, sizeof direction[i]);
      t_min[i] = 0.0F;
      primitive[i] = 0;
    }
  }
};

static_assert(HitCandidates::kMost % HitCandidates::kGroup == 0);

}  // namespace grove
