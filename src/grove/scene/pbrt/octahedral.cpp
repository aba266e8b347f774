#include "grove/scene/pbrt/octahedral.h"

#include <algorithm>
#include <cmath>

#include "grove/base/parallel.h"

namespace grove::pbrt {
namespace {

float decode_srgb(std::uint8_t byte) {
  const float v = static_cast<float>(byte) / 255.0F;
  return v <= 0.04045F ? v / 12.92F : std::pow((v + 0.055F) / 1.055F, 2.4F);
}

Vec3 pixel(const Image& image, std::size_t index) {
  Vec3 rgb;
  for (std::uint32_t c = 0; c < 3; ++c) {
    const std::size_t at = index * image.channels + (image.channels >= 3 ? c : 0);
    rgb[static_cast<int>(c)] = image.is_float() ? image.floats[at] : decode_srgb(image.bytes[at]);
  }
  return rgb;
}

// Bilinear, around in u, up to the poles in v.
Vec3 sample_equirectangular(const Image& image, float u, float v) {
  const auto width = static_cast<std::int64_t>(image.width), height = static_cast<std::int64_t>(image.height);
  const float x = u * static_cast<float>(width) - 0.5F, y = v * static_cast<float>(height) - 0.5F;
  const float fx = x - std::floor(x), fy = y - std::floor(y);
  const auto x0 = static_cast<std::int64_t>(std::floor(x)), y0 = static_cast<std::int64_t>(std::floor(y));
  const auto at = [&](std::int64_t column, std::int64_t row) {
    column = (column % width + width) % width;
    row = std::clamp<std::int64_t>(row, 0, height - 1);
    return pixel(image, static_cast<std::size_t>(row * width + column));
  };
  return (1.0F - fy) * ((1.0F - fx) * at(x0, y0) + fx * at(x0 + 1, y0)) + fy * ((1.0F - fx) * at(x0, y0 + 1) + fx * at(x0 + 1, y0 + 1));
}

Image rgb_image(const Image& like, std::uint32_t width, std::uint32_t height) {
  Image image;
  image.name = like.name;
  image.width = width;
  image.height = height;
  image.channels = 3;
  image.floats.resize(std::size_t{3} * width * height);
  return image;
}

void set_pixel(Image& image, std::size_t index, const Vec3& rgb) {
  for (int c = 0; c < 3; ++c) image.floats[3 * index + static_cast<std::size_t>(c)] = rgb[c];
}

Vec2 pixel_centre(std::size_t index, std::uint32_t size) {
  const std::size_t row = index / size;
  const std::size_t column = index % size;
  return {(static_cast<float>(column) + 0.5F) / static_cast<float>(size), (static_cast<float>(row) + 0.5F) / static_cast<float>(size)};
}

}  // namespace

Vec3 octahedral_direction(const Vec2& uv) {
  const float u = 2.0F * uv.x - 1.0F, v = 2.0F * uv.y - 1.0F;
  const float up = std::abs(u), vp = std::abs(v);
  // Signed distance from the diamond's edge: how far above or below the horizon.
  const float distance = 1.0F - (up + vp);
  const float r = 1.0F - std::abs(distance);
  const float phi = (r == 0.0F ? 1.0F : (vp - up) / r + 1.0F) * (kPi / 4.0F);
  const float z = std::copysign(1.0F - r * r, distance);
  const float radial = r * std::sqrt(std::max(0.0F, 2.0F - r * r));
  return {std::copysign(std::cos(phi), u) * radial, std::copysign(std::sin(phi), v) * radial, z};
}

Image equirectangular_to_octahedral(const Image& source) {
  const double pixels = static_cast<double>(source.width) * source.height;
  const auto size = std::max(1U, static_cast<std::uint32_t>(std::lround(std::sqrt(pixels))));
  Image result = rgb_image(source, size, size);
  parallel_for(std::size_t{size} * size, 4096, [&](std::size_t i) {
    const Vec3 direction = octahedral_direction(pixel_centre(i, size));
    const float azimuth = std::atan2(direction.y, direction.x) / (2.0F * kPi);
    const float polar = std::acos(std::clamp(direction.z, -1.0F, 1.0F)) / kPi;
    set_pixel(result, i, sample_equirectangular(source, azimuth < 0.0F ? azimuth + 1.0F : azimuth, polar));
  });
  return result;
}

Image to_linear_floats(const Image& source) {
  Image result = rgb_image(source, source.width, source.height);
  for (std::size_t i = 0; i < std::size_t{source.width} * source.height; ++i) set_pixel(result, i, pixel(source, i));
  return result;
}

float upper_illuminance(const Image& image) {
  const std::size_t count = std::size_t{image.width} * image.height;
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 direction = octahedral_direction(pixel_centre(i, image.width));
    if (direction.z <= 0.0F) continue;
    const Vec3 rgb = pixel(image, i);
    sum += double{direction.z} * (0.2126 * double{rgb.x} + 0.7152 * double{rgb.y} + 0.0722 * double{rgb.z});
  }
  // Every pixel covers 4 pi / count of the sphere.
  return static_cast<float>(sum * 4.0 * 3.14159265358979323846 / static_cast<double>(count));
}

}  // namespace grove::pbrt
