#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "grove/lab/batch.h"
#include "grove/scene/camera.h"

namespace grove {

/// How many steps (nodes visited and primitives tested) the camera ray through the middle of each pixel takes.
struct HeatMap {
  std::string structure;             ///< canonical spec
  std::uint64_t max = 0;             ///< the most steps of any pixel
  std::vector<std::uint16_t> steps;  ///< row by row from the top, kHeatMapWidth each; what is more than 65,535 is that
};

inline constexpr std::uint32_t kHeatMapWidth = 320;
inline constexpr std::uint32_t kHeatMapHeight = 180;

/// Rays are traced to the closest hit, in parallel in the caller's oneTBB arena.
[[nodiscard]] HeatMap draw_heat_map(const std::string& structure, const Accelerator& accelerator, const Camera& camera);

/// The steps as little-endian 16-bit numbers in base 64 (RFC 4648, with padding).
[[nodiscard]] std::string heat_map_base64(const HeatMap& map);

}  // namespace grove
