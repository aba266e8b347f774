#include "grove/lab/heat_map.h"

#include <algorithm>
#include <limits>

#include "grove/render/camera_rays.h"

namespace grove {

HeatMap draw_heat_map(const std::string& structure, const Accelerator& accelerator, const Camera& camera) {
  Camera pinhole = camera;
  pinhole.lens_radius = 0.0F;
  const CameraRays camera_rays(pinhole, kHeatMapWidth, kHeatMapHeight);
  std::vector<Ray> rays;
  rays.reserve(std::size_t{kHeatMapWidth} * kHeatMapHeight);
  for (std::uint32_t y = 0; y < kHeatMapHeight; ++y) {
    for (std::uint32_t x = 0; x < kHeatMapWidth; ++x)
      rays.push_back(camera_rays.ray({static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F}, {0.5F, 0.5F}));
  }
  std::vector<Hit> hits(rays.size());
  std::vector<TraversalCounts> counts(rays.size());
  trace_counted(accelerator, Query::closest, rays, hits, counts);
  HeatMap map;
  map.structure = structure;
  map.steps.reserve(rays.size());
  for (const TraversalCounts& count : counts) {
    const std::uint64_t steps = count.nodes_visited + count.primitives_tested;
    map.max = std::max(map.max, steps);
    map.steps.push_back(static_cast<std::uint16_t>(std::min<std::uint64_t>(steps, std::numeric_limits<std::uint16_t>::max())));
  }
  return map;
}

std::string heat_map_base64(const HeatMap& map) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint32_t> bytes;
  bytes.reserve(2 * map.steps.size());
  for (const std::uint16_t steps : map.steps) {
    bytes.push_back(steps & 0xffU);
    bytes.push_back(steps >> 8U);
  }
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t present = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8U | (k < present ? bytes[i + k] : 0U);
    for (std::size_t digit = 0; digit < 4; ++digit) text += digit <= present ? kDigits[word >> (18 - 6 * digit) & 63U] : '=';
  }
  return text;
}

}  // namespace grove
