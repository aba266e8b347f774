#include "grove/render/film.h"

#include <algorithm>
#include <cmath>

#include "grove/render/bsdf/bsdf_types.h"

namespace grove {
namespace {

bool is_valid(const Vec3& radiance) {
  // A NaN fails every comparison.
  for (int channel = 0; channel < 3; ++channel)
    if (!(radiance[channel] >= 0.0F) || !std::isfinite(radiance[channel])) return false;
  return true;
}

}  // namespace

float Film::Pixel::mean_luminance() const {
  return sample_count == 0 ? 0.0F : luminance(sum.radiance) / static_cast<float>(sample_count);
}

float Film::Pixel::squared_deviations() const {
  if (sample_count < 2) return 0.0F;
  // In double: what is left of two nearly equal numbers. Rounding may make it negative where all samples are alike.
  const auto total = static_cast<double>(luminance(sum.radiance));
  const double deviations = static_cast<double>(squares) - total * total / sample_count;
  return static_cast<float>(std::max(0.0, deviations));
}

float Film::sample_variance(std::uint32_t x, std::uint32_t y) const {
  const Pixel& p = pixel(x, y);
  return p.sample_count < 2 ? 0.0F : p.squared_deviations() / static_cast<float>(p.sample_count - 1);
}

float Film::variance_of_mean(std::uint32_t x, std::uint32_t y) const {
  const Pixel& p = pixel(x, y);
  return p.sample_count < 2 ? 0.0F : sample_variance(x, y) / static_cast<float>(p.sample_count);
}

bool Film::add(std::uint32_t x, std::uint32_t y, const Sample& sample) {
  Pixel& pixel = pixels_[std::size_t{y} * width_ + x];
  if (!is_valid(sample.radiance)) {
    ++pixel.dropped_count;
    return false;
  }
  pixel.sum.radiance += sample.radiance;
  pixel.sum.albedo += sample.albedo;
  pixel.sum.normal += sample.normal;
  const float value = luminance(sample.radiance);
  pixel.squares += value * value;
  ++pixel.sample_count;
  return true;
}

void Film::add(std::uint32_t x, std::uint32_t y, const Pixel& other) {
  Pixel& pixel = pixels_[std::size_t{y} * width_ + x];
  if (pixel.taken() == 0) {
    pixel = other;
    return;
  }
  pixel.sum.radiance += other.sum.radiance;
  pixel.sum.albedo += other.sum.albedo;
  pixel.sum.normal += other.sum.normal;
  pixel.squares += other.squares;
  pixel.sample_count += other.sample_count;
  pixel.dropped_count += other.dropped_count;
}

std::uint64_t Film::dropped_samples() const {
  std::uint64_t count = 0;
  for (const Pixel& pixel : pixels_) count += pixel.dropped_count;
  return count;
}

Film::Sample Film::mean(std::uint32_t x, std::uint32_t y) const {
  const Pixel& p = pixel(x, y);
  if (p.sample_count == 0) return {};
  const auto count = static_cast<float>(p.sample_count);
  return {p.sum.radiance / count, p.sum.albedo / count, p.sum.normal / count};
}

}  // namespace grove
