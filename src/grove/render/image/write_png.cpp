#include "grove/render/image/write_png.h"

#include <algorithm>
#include <cmath>
#include <vector>

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

#include "grove/base/error.h"
#include "grove/base/output_file.h"
#include "grove/render/image/colour_map.h"
#include "grove/render/image/tone_map.h"

namespace grove {
namespace {

// The colours of all pixels that hold samples, by one channel.
std::vector<float> channel_values(const Film& film, const ColourImage& colours, int channel) {
  std::vector<float> values;
  values.reserve(colours.pixels.size());
  for (std::uint32_t y = 0; y < film.height(); ++y)
    for (std::uint32_t x = 0; x < film.width(); ++x)
      if (film.pixel(x, y).sample_count > 0) values.push_back(colours.at(x, y)[channel]);
  return values;
}

float percentile(std::vector<float> values, double part) {
  if (values.empty()) return 0.0F;
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

// Turns the mean of a pixel into what the screen shows, sRGB-encoded in [0, 1].
class Display {
 public:
  Display(const RenderResult& result, const ColourImage& colours, const DisplaySettings& settings)
      : integrator_(result.integrator), tone_map_(settings.tone_map), gain_(std::exp2(settings.exposure)) {
    if (integrator_ == Integrator::cost) high_ = percentile(channel_values(result.film, colours, 2), 0.99);
    if (integrator_ == Integrator::depth) {
      std::vector<float> depths = channel_values(result.film, colours, 0);
      std::erase(depths, 0.0F);
      low_ = percentile(depths, 0.0);
      high_ = percentile(depths, 1.0);
    }
  }

  [[nodiscard]] Vec3 operator()(const Vec3& value) const {
    switch (integrator_) {
      case Integrator::cost:
        return colour_map(high_ > 0.0F ? value.z / high_ : 0.0F);
      case Integrator::depth: {
        if (value.x == 0.0F) return Vec3(0.0F);
        // The farthest surface stays apart from the black of nothing.
        const float nearness = high_ > low_ ? (high_ - value.x) / (high_ - low_) : 1.0F;
        return Vec3(std::clamp(0.1F + 0.9F * nearness, 0.0F, 1.0F));
      }
      case Integrator::normal:
        return value;  // a normal is data: encoding would bend it
      case Integrator::path:
        return encoded(tone_map(tone_map_, gain_ * value));
      case Integrator::ao:
        return encoded(value);
    }
    return encoded(value);
  }

 private:
  static Vec3 encoded(const Vec3& linear) { return {encode_srgb(linear.x), encode_srgb(linear.y), encode_srgb(linear.z)}; }

  Integrator integrator_;
  ToneMap tone_map_;
  float gain_;
  float low_ = 0.0F;
  float high_ = 0.0F;
};

std::uint8_t to_byte(float value) {
  return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(value, 0.0F, 1.0F)));
}

}  // namespace

void write_png(const RenderResult& result, const DisplaySettings& settings, const std::filesystem::path& path) {
  OutputFile file(path);
  const Film& film = result.film;
  const ColourImage colours = result.colours();
  const Display display(result, colours, settings);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(std::size_t{film.width()} * film.height() * 3);
  for (std::uint32_t y = 0; y < film.height(); ++y) {
    for (std::uint32_t x = 0; x < film.width(); ++x) {
      const bool is_finished = film.pixel(x, y).sample_count > 0;
      const Vec3 shown = is_finished ? display(colours.at(x, y)) : Vec3(0.0F);
      for (int channel = 0; channel < 3; ++channel) bytes.push_back(to_byte(shown[channel]));
    }
  }
  // The encoder is C and must not be thrown through: it gathers the file in memory.
  std::vector<std::uint8_t> encoded;
  const auto gather = [](void* context, void* data, int size) {
    auto& target = *static_cast<std::vector<std::uint8_t>*>(context);
    const auto* first = static_cast<const std::uint8_t*>(data);
    target.insert(target.end(), first, first + size);
  };
  const int width = static_cast<int>(film.width());
  if (stbi_write_png_to_func(gather, &encoded, width, static_cast<int>(film.height()), 3, bytes.data(), width * 3) == 0) {
    throw OutputError(path.string() + ": the PNG encoder failed");
  }
  file.write(encoded.data(), encoded.size());
  file.commit();
}

}  // namespace grove
