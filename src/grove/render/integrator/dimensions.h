#pragma once

#include <cstdint>

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

/// Chances of passing transparent surfaces, counted along the whole path.
inline constexpr std::uint32_t kFirstOpacityDimension = 0x80000000U;

}  // namespace grove
