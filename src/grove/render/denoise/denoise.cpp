#include "grove/render/denoise/denoise.h"

#include <algorithm>
#include <array>
#include <string>

#include "grove/base/check.h"
#include "grove/base/error.h"
#include "grove/base/parallel.h"
#include "grove/render/bsdf/bsdf_types.h"
#include "grove/render/denoise/fireflies.h"

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

TakenApart take_apart(const RenderResult& result) {
  GROVE_CHECK(result.first_hits);
  const Film& film = result.film;
  const std::size_t count = std::size_t{film.width()} * film.height();
  TakenApart parts{Guides::of(film, *result.first_hits), Illumination(count), std::vector<MeasuredNoise>(count), std::vector<Vec3>(count)};
  parallel_for(film.height(), 4, [&](std::size_t row) {
    const auto y = static_cast<std::uint32_t>(row);
    for (std::uint32_t x = 0; x < film.width(); ++x) {
      const std::size_t i = row * film.width() + x;
      const Vec3 by = divisor(parts.guides.albedo[i]);
      const Vec3& emitted = result.first_hits->at(x, y).emitted;
      parts.emitted[i] = emitted;
      parts.light.set_colour(i, glm::max(film.mean(x, y).radiance - emitted, Vec3(0.0F)) / by);
      const float scale = 1.0F / luminance(by);
      parts.noise[i] = {scale * scale * film.variance_of_mean(x, y), film.pixel(x, y).sample_count >= 2, emitted == Vec3(0.0F)};
    }
  });
  return parts;
}

Illumination filter_light(Illumination light, std::vector<MeasuredNoise> noise, const Guides& guides, const FilterSettings& settings,
                          BrightnessEvidence evidence) {
  for (std::size_t i = 0; i < noise.size(); ++i) evidence.samples.variance[i] = noise[i].variance;
  limit_fireflies(noise, guides, light);
  estimate_noise(noise, guides, light);
  for (std::size_t i = 0; i < noise.size(); ++i) {
    // A single sample does not tell how sure it is, but its neighbours do.
    if (noise[i].is_known) continue;
    evidence.samples.variance[i] = light.variance[i];
    if (evidence.has_newest()) evidence.newest.variance[i] = light.variance[i];
  }
  Illumination filtered = filter_a_trous(std::move(light), guides, settings);
  keep_brightness(evidence, guides, filtered);
  return filtered;
}

ColourImage denoise(const RenderResult& result, const FilterSettings& settings) {
  TakenApart parts = take_apart(result);
  BrightnessEvidence evidence{parts.light, Illumination()};
  const Illumination light = filter_light(std::move(parts.light), std::move(parts.noise), parts.guides, settings, std::move(evidence));
  ColourImage image = mean_colours(result.film);
  parallel_for(image.pixels.size(), 4096, [&](std::size_t i) {
    if (parts.guides.is_surface(i)) image.pixels[i] = light.colour(i) * divisor(parts.guides.albedo[i]) + parts.emitted[i];
  });
  return image;
}

}  // namespace grove
