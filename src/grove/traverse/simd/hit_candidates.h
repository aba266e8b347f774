#pragma once

#include <cstddef>
#include <cstdint>

#include "grove/accel/fast_bvh.h"
#include "grove/traverse/simd/batch_ray.h"

namespace grove {

/// Pairs of a ray and a triangle that it may hit, by number, waiting to be tested side by side.
struct HitCandidates {
  static constexpr std::size_t kMost = 64;
  static constexpr std::size_t kGroup = 4;  ///< so many are tested at once

  /// Along the axes kx, ky, kz of the ray.
  alignas(64) float corner[3][3][kMost];
  float minus_origin[3][kMost];
  float direction[3][kMost];
  float shear[2][kMost];
  /// What the test tells, and which of it is valid, by bits.
  float t[kMost];
  float weight[3][kMost];
  std::uint64_t known;
  /// Whose they are.
  std::uint8_t slot[kMost];
  std::uint8_t place[kMost];
  std::size_t count = 0;

  [[nodiscard]] bool is_full() const { return count == kMost; }

  void append(std::uint32_t slot_number, const BatchRay& ray, const TriangleBlock& block, std::uint32_t block_place) {
    const std::uint32_t axes[3] = {ray.axes.kx, ray.axes.ky, ray.axes.kz};
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < 3; ++i) corner[axis][i][count] = block.corners[axes[axis]][i][block_place];
      minus_origin[axis][count] = ray.minus_origin_k[axis];
      direction[axis][count] = ray.direction_k[axis];
    }
    shear[0][count] = ray.shear_x;
    shear[1][count] = ray.shear_y;
    slot[count] = static_cast<std::uint8_t>(slot_number);
    place[count] = static_cast<std::uint8_t>(block_place);
    ++count;
  }

  /// Gives the last group numbers that mean nothing in its free lanes.
  void fill_up() {
    for (std::size_t i = count; i % kGroup != 0; ++i) {
      for (auto& by_corner : corner)
        for (auto& lanes : by_corner) lanes[i] = 0.0F;
      for (auto& lanes : minus_origin) lanes[i] = 0.0F;
      for (auto& lanes : direction) lanes[i] = 0.0F;
      for (auto& lanes : shear) lanes[i] = 0.0F;
    }
  }
};

static_assert(HitCandidates::kMost % HitCandidates::kGroup == 0);

}  // namespace grove
