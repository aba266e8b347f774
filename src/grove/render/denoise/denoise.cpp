#include "grove/render/denoise/denoise.h"

#include <algorithm>
#include <array>
#include <string>

#include "grove/base/check.h"
#include "grove/base/error.h"
#include "grove/base/parallel.h"
#include "grove/render/bsdf/bsdf_types.h"
#include "grove/render/denoise/noise_estimate.h"

namespace grove {
namespace {

constexpr std::array<std::string_view, 3> kNames = {"off", "spatial", "temporal"};

}  // namespace

std::span<const std::string_view> denoise_names() {
  return kNames;
}

Denoise denoise_from_name(std::string_view name) {
  const auto* const found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) throw UsageError("unknown way '" + std::string(name) + "'; choose one of off, spatial, temporal");
  return static_cast<Denoise>(found - kNames.begin());
}

ColourImage denoise(const RenderResult& result, const FilterSettings& settings) {
  GROVE_CHECK(result.first_hits && result.moments);
  const Film& film = result.film;
  const Guides guides = Guides::of(film, *result.first_hits);
  ColourImage image = mean_colours(film);
  const std::size_t count = image.pixels.size();
  Illumination light(count);
  std::vector<MeasuredNoise> measured(count);
  parallel_for(film.height(), 4, [&](std::size_t row) {
    const auto y = static_cast<std::uint32_t>(row);
    for (std::uint32_t x = 0; x < film.width(); ++x) {
      const std::size_t i = row * film.width() + x;
      const Vec3 by = divisor(guides.albedo[i]);
      const Vec3& emitted = result.first_hits->at(x, y).emitted;
      light.set_colour(i, glm::max(image.pixels[i] - emitted, Vec3(0.0F)) / by);
      const float scale = 1.0F / luminance(by);
      measured[i] = {scale * scale * result.moments->variance_of_mean(x, y), result.moments->count(x, y) >= 2, emitted == Vec3(0.0F)};
    }
  });
  estimate_noise(measured, guides, light);
  light = filter_a_trous(std::move(light), guides, settings);
  parallel_for(count, 4096, [&](std::size_t i) {
    if (!guides.is_surface(i)) return;
    const auto x = static_cast<std::uint32_t>(i % film.width());
    const auto y = static_cast<std::uint32_t>(i / film.width());
    image.pixels[i] = light.colour(i) * divisor(guides.albedo[i]) + result.first_hits->at(x, y).emitted;
  });
  return image;
}

}  // namespace grove
