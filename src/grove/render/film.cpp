#include "grove/render/film.h"

#include <cmath>

namespace grove {
namespace {

bool is_valid(const Vec3& radiance) {
  // A NaN fails every comparison.
  for (int channel = 0; channel < 3; ++channel)
    if (!(radiance[channel] >= 0.0F) || !std::isfinite(radiance[channel])) return false;
  return true;
}

}  // namespace

bool Film::add(std::uint32_t x, std::uint32_t y, const Sample& sample) {
  if (!is_valid(sample.radiance)) return false;
  Pixel& pixel = pixels_[std::size_t{y} * width_ + x];
  pixel.sum.radiance += sample.radiance;
  pixel.sum.albedo += sample.albedo;
  pixel.sum.normal += sample.normal;
  ++pixel.sample_count;
  return true;
}

Film::Sample Film::mean(std::uint32_t x, std::uint32_t y) const {
  const Pixel& p = pixel(x, y);
  if (p.sample_count == 0) return {};
  const auto count = static_cast<float>(p.sample_count);
  return {p.sum.radiance / count, p.sum.albedo / count, p.sum.normal / count};
}

}  // namespace grove
