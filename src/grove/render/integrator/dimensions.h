#pragma once

#include <cstdint>

#include "grove/geometry/hit.h"

// Which sampler dimension decides what. Each number is used for one purpose, so that no two decisions of a path are correlated.

namespace grove {

inline constexpr std::uint32_t kFilmDimension = 0;
inline constexpr std::uint32_t kLensDimension = 1;
inline constexpr std::uint32_t kFirstVertexDimension = 2;

/// Within the block of a path vertex.
enum class VertexDimension : std::uint32_t { light_choice, light_point, lobe, direction, roulette, material, count };

/// `vertex` counts surfaces along the path from 0.
[[nodiscard]] constexpr std::uint32_t dimension(std::uint32_t vertex, VertexDimension purpose) {
  return kFirstVertexDimension + vertex * static_cast<std::uint32_t>(VertexDimension::count) + static_cast<std::uint32_t>(purpose);
}

/// Chances of passing transparent surfaces lie beyond.
inline constexpr std::uint32_t kFirstOpacityDimension = 0x80000000U;

/// The chance of passing what was hit, from which side, after `vertex` surfaces scattered the path. Mixed as the finaliser of MurmurHash3 does; two that
/// come out the same are correlated and no worse.
[[nodiscard]] constexpr std::uint32_t opacity_dimension(std::uint32_t vertex, const Hit& hit, bool is_outside) {
  std::uint32_t mixed = is_outside ? 1 : 0;
  for (const std::uint32_t word : {vertex, hit.instance, hit.geometry, hit.primitive}) {
    mixed = (mixed ^ word) * 0x85ebca6bU;
    mixed = (mixed ^ mixed >> 13) * 0xc2b2ae35U;
    mixed ^= mixed >> 16;
  }
  return kFirstOpacityDimension | mixed;
}

}  // namespace grove
