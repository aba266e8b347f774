#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "grove/math/vector.h"

namespace grove {

/// Sums of samples per pixel, row 0 at the top. A pixel is written by one thread at a time and its samples are added in order of their
/// number, so that the sums do not depend on the threads. The means are linear. Memory: 48 bytes a pixel.
class Film {
 public:
  /// What one camera sample saw: light, and guides for a denoiser from the first surface (zero where there is none).
  struct Sample {
    Vec3 radiance{0.0F};
    Vec3 albedo{0.0F};
    Vec3 normal{0.0F};  ///< world space, unit length, on the viewer's side
  };

  struct Pixel {
    Sample sum;
    float squares = 0.0F;             ///< sum of the squared luminances of the samples' radiance
    std::uint32_t sample_count = 0;   ///< in the sum
    std::uint32_t dropped_count = 0;  ///< left out of it

    /// Samples that were taken, from the first on: the number of the next.
    [[nodiscard]] std::uint64_t taken() const { return std::uint64_t{sample_count} + dropped_count; }

    /// Of the luminance of all samples.
    [[nodiscard]] float mean_luminance() const;
    /// The sum of the squared distances of the samples' luminances from their mean: n - 1 times their unbiased variance.
    [[nodiscard]] float squared_deviations() const;
  };

  Film() = default;
  Film(std::uint32_t width, std::uint32_t height) : width_(width), height_(height), pixels_(std::size_t{width} * height) {}

  [[nodiscard]] std::uint32_t width() const { return width_; }
  [[nodiscard]] std::uint32_t height() const { return height_; }

  /// Adds a sample, unless its radiance holds a NaN, an infinity or a negative number: then counts it as dropped and returns false.
  bool add(std::uint32_t x, std::uint32_t y, const Sample& sample);

  /// Takes a pixel back to what it was.
  void restore(std::uint32_t x, std::uint32_t y, const Pixel& earlier) { pixels_[std::size_t{y} * width_ + x] = earlier; }

  /// Adds other samples of a pixel; where it holds none yet, it has the very bits of `other` afterwards.
  void add(std::uint32_t x, std::uint32_t y, const Pixel& other);

  /// The mean of the samples; zeros where there is none.
  [[nodiscard]] Sample mean(std::uint32_t x, std::uint32_t y) const;

  /// The unbiased variance of the luminance of one sample of the pixel; 0 for fewer than two samples, which tell nothing of it.
  [[nodiscard]] float sample_variance(std::uint32_t x, std::uint32_t y) const;
  /// The variance of the mean of as many samples as there are, if they had nothing to do with each other. They are spread more evenly than that, so
  /// the true variance is lower.
  [[nodiscard]] float variance_of_mean(std::uint32_t x, std::uint32_t y) const;

  [[nodiscard]] const Pixel& pixel(std::uint32_t x, std::uint32_t y) const { return pixels_[std::size_t{y} * width_ + x]; }

  /// Over all pixels.
  [[nodiscard]] std::uint64_t dropped_samples() const;

 private:
  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
  std::vector<Pixel> pixels_;
};

}  // namespace grove
