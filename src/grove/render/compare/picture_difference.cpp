#include "grove/render/compare/picture_difference.h"

#include <cmath>
#include <string>

#include "grove/base/error.h"
#include "grove/base/parallel.h"
#include "grove/render/compare/flip.h"
#include "grove/scene/read_image.h"

namespace grove {
namespace {

double mean(const Plane& plane) {
  double sum = 0.0;
  for (const float value : plane) sum += value;
  return plane.empty() ? 0.0 : sum / static_cast<double>(plane.size());
}

ColourImage displayed(const ColourImage& image, float gain, ToneMap curve) {
  ColourImage result(image.width, image.height);
  parallel_for(image.pixels.size(), 4096, [&](std::size_t i) { result.pixels[i] = tone_map(curve, gain * image.pixels[i]); });
  return result;
}

std::string size_text(std::uint32_t width, std::uint32_t height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

}  // namespace

PictureDifference compare_pictures(const ColourImage& reference, const ColourImage& test, float gain, ToneMap curve) {
  constexpr double kDarkest = 0.01;
  PictureDifference result;
  double squares = 0.0;
  double relative_squares = 0.0;
  double sum = 0.0;
  double reference_sum = 0.0;
  for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double there = reference.pixels[i][c];
      const double here = test.pixels[i][c];
      const double square = (here - there) * (here - there);
      squares += square;
      relative_squares += square / (there * there + kDarkest);
      sum += here;
      reference_sum += there;
    }
  }
  const auto count = static_cast<double>(3 * reference.pixels.size());
  result.rmse = std::sqrt(squares / count);
  result.relative_mse = relative_squares / count;
  result.relative_bias = reference_sum > 0.0 ? (sum - reference_sum) / reference_sum : 0.0;
  result.flip = mean(flip(displayed(reference, gain, curve), displayed(test, gain, curve)));
  result.hdr_flip = mean(hdr_flip(reference, test).difference);
  return result;
}

ColourImage read_reference(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height) {
  const Image image = read_image(file);
  if (!image.is_float()) throw InputError(file.string(), "", "is a picture of 8 bits; compare with linear light, an .exr, .hdr or .pfm");
  if (image.width != width || image.height != height) {
    throw InputError(file.string(), "",
                     "is a picture of " + size_text(image.width, image.height) + " pixels, and this one has " + size_text(width, height) +
                         "; render at the same size");
  }
  ColourImage result(width, height);
  const bool is_grey = image.channels < 3;
  for (std::size_t i = 0; i < result.pixels.size(); ++i) {
    const float* const pixel = image.floats.data() + i * image.channels;
    result.pixels[i] = is_grey ? Vec3(pixel[0]) : Vec3(pixel[0], pixel[1], pixel[2]);
  }
  return result;
}

}  // namespace grove
