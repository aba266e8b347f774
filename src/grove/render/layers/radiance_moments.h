#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "grove/render/bsdf/bsdf_types.h"
#include "grove/render/film.h"

namespace grove {

/// Mean and spread of the luminance of each pixel's samples, row 0 at the top; gathered sample by sample without loss of digits (Welford 1962,
/// "Note on a method for calculating corrected sums of squares and products"). A pixel is written by one thread at a time. Memory: 12 bytes a pixel.
class RadianceMoments {
 public:
  RadianceMoments() = default;
  RadianceMoments(std::uint32_t width, std::uint32_t height) : width_(width), pixels_(std::size_t{width} * height) {}

  [[nodiscard]] bool is_empty() const { return pixels_.empty(); }

  /// Adds the luminance of a sample that the film took.
  void add(std::uint32_t x, std::uint32_t y, float luminance) {
    Pixel& pixel = pixels_[std::size_t{y} * width_ + x];
    ++pixel.count;
    const float from_old_mean = luminance - pixel.mean;
    pixel.mean += from_old_mean / static_cast<float>(pixel.count);
    pixel.squares += from_old_mean * (luminance - pixel.mean);
  }

  [[nodiscard]] std::uint32_t count(std::uint32_t x, std::uint32_t y) const { return at(x, y).count; }

  /// The unbiased variance of a single sample of the pixel; 0 for fewer than two samples, which tell nothing of it.
  [[nodiscard]] float sample_variance(std::uint32_t x, std::uint32_t y) const {
    const Pixel& pixel = at(x, y);
    return pixel.count < 2 ? 0.0F : pixel.squares / static_cast<float>(pixel.count - 1);
  }

  /// The variance of the mean of `count` samples that have nothing to do with each other. Samples of this renderer are spread more evenly than that, so
  /// the true variance is lower, the more so the more samples there are.
  [[nodiscard]] float variance_of_mean(std::uint32_t x, std::uint32_t y) const {
    const Pixel& pixel = at(x, y);
    return pixel.count < 2 ? 0.0F : sample_variance(x, y) / static_cast<float>(pixel.count);
  }

 private:
  struct Pixel {
    float mean = 0.0F;
    float squares = 0.0F;  // sum of squared distances from the mean
    std::uint32_t count = 0;
  };

  [[nodiscard]] const Pixel& at(std::uint32_t x, std::uint32_t y) const { return pixels_[std::size_t{y} * width_ + x]; }

  std::uint32_t width_ = 0;
  std::vector<Pixel> pixels_;
};

/// Adds a sample to the film and, where it was taken and there are any, to the moments.
inline void add_sample(Film& film, RadianceMoments* moments, std::uint32_t x, std::uint32_t y, const Film::Sample& sample) {
  if (film.add(x, y, sample) && moments != nullptr) moments->add(x, y, luminance(sample.radiance));
}

}  // namespace grove
