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
  Pixel& pixel = pixels_[std::size_t{y} * width_ + x];
  if (!is_valid(sample.radiance)) {
    ++pixel.dropped_count;
    return false;
  }
  pixel.sum.radiance += sample.radiance;
  pixel.sum.albedo += sample.albedo;
  pixel.sum.normal += sample.normal;
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
