#include "grove/render/texture/evaluate_texture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "grove/render/bsdf/bsdf_types.h"

namespace grove {
namespace {

// 8-bit sRGB to linear (IEC 61966-2-1).
const std::array<float, 256>& srgb_table() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double encoded = static_cast<double>(i) / 255.0;
      values[i] = static_cast<float>(encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4));
    }
    return values;
  }();
  return table;
}

// A texel index brought into [0, size); false where the wrap mode says that there is nothing.
bool wrap(TextureWrap mode, std::int64_t size, std::int64_t& i) {
  if (i >= 0 && i < size) return true;
  switch (mode) {
    case TextureWrap::repeat: {
      i %= size;
      if (i < 0) i += size;
      return true;
    }
    case TextureWrap::mirror: {
      i %= 2 * size;
      if (i < 0) i += 2 * size;
      if (i >= size) i = 2 * size - 1 - i;
      return true;
    }
    case TextureWrap::clamp: {
      i = std::clamp<std::int64_t>(i, 0, size - 1);
      return true;
    }
    case TextureWrap::black:
      return false;
  }
  return false;
}

Vec4 texel(const Image& image, const Texture& texture, std::int64_t x, std::int64_t y) {
  if (!wrap(texture.wrap_u, image.width, x) || !wrap(texture.wrap_v, image.height, y)) return Vec4(0.0F);
  const std::size_t first = (static_cast<std::size_t>(y) * image.width + static_cast<std::size_t>(x)) * image.channels;
  float value[4] = {0.0F, 0.0F, 0.0F, 1.0F};
  const bool has_alpha = image.channels == 2 || image.channels == 4;
  for (std::uint32_t c = 0; c < image.channels; ++c) {
    if (image.is_float()) {
      value[c] = image.floats[first + c];
    } else {
      const std::uint8_t byte = image.bytes[first + c];
      const bool is_colour = !(has_alpha && c + 1 == image.channels);
      value[c] = texture.srgb && is_colour ? srgb_table()[byte] : static_cast<float>(byte) / 255.0F;
    }
  }
  if (image.channels == 1) return {value[0], value[0], value[0], 1.0F};
  if (image.channels == 2) return {value[0], value[0], value[0], value[1]};
  return {value[0], value[1], value[2], value[3]};
}

Vec4 evaluate_image(const Image& image, const Texture& texture, const Vec2& uv) {
  if (image.width == 0 || image.height == 0 || (image.bytes.empty() && image.floats.empty())) return Vec4(0.0F);
  // In double, so that far-off coordinates of repeated textures keep their place within a texel.
  const double x = static_cast<double>(uv.x) * image.width;
  const double y = static_cast<double>(uv.y) * image.height;
  constexpr double kFar = 1e15;  // beyond this a double has no fraction left
  if (!(std::fabs(x) < kFar && std::fabs(y) < kFar)) return Vec4(0.0F);
  if (texture.filter == TextureFilter::nearest) {
    return texel(image, texture, static_cast<std::int64_t>(std::floor(x)), static_cast<std::int64_t>(std::floor(y)));
  }
  // Texel centres are at half-integers.
  const double left = std::floor(x - 0.5);
  const double top = std::floor(y - 0.5);
  const auto fx = static_cast<float>(x - 0.5 - left);
  const auto fy = static_cast<float>(y - 0.5 - top);
  const auto x0 = static_cast<std::int64_t>(left);
  const auto y0 = static_cast<std::int64_t>(top);
  const Vec4 upper = texel(image, texture, x0, y0) * (1.0F - fx) + texel(image, texture, x0 + 1, y0) * fx;
  const Vec4 lower = texel(image, texture, x0, y0 + 1) * (1.0F - fx) + texel(image, texture, x0 + 1, y0 + 1) * fx;
  return upper * (1.0F - fy) + lower * fy;
}

Vec4 operand(const Scene& scene, const Texture& texture, int i, const TextureCoordinates& uv) {
  return texture.operand[i] == kNoTexture ? texture.value[i] : evaluate_texture(scene, texture.operand[i], uv);
}

}  // namespace

Vec4 evaluate_texture(const Scene& scene, std::uint32_t texture_id, const TextureCoordinates& uv) {
  if (texture_id == kNoTexture) return Vec4(1.0F);
  const Texture& texture = scene.textures[texture_id];
  switch (texture.kind) {
    case TextureKind::constant:
      return texture.value[0];
    case TextureKind::image: {
      const Vec2 place = Vec2(texture.uv_transform * Vec3(uv.of(texture.uv_set), 1.0F));
      const Vec4 value = evaluate_image(*scene.images[texture.image], texture, place);
      return (texture.invert ? Vec4(1.0F) - value : value) * texture.value[0];
    }
    case TextureKind::checkerboard: {
      const Vec2 place = Vec2(texture.uv_transform * Vec3(uv.of(texture.uv_set), 1.0F));
      const float cells = std::floor(place.x) + std::floor(place.y);
      return operand(scene, texture, std::fmod(cells, 2.0F) == 0.0F ? 0 : 1, uv);
    }
    case TextureKind::scale:
      return operand(scene, texture, 0, uv) * operand(scene, texture, 1, uv);
    case TextureKind::mix: {
      const float amount = texture.amount_texture == kNoTexture ? texture.amount : evaluate_texture(scene, texture.amount_texture, uv).x;
      return operand(scene, texture, 0, uv) * (1.0F - amount) + operand(scene, texture, 1, uv) * amount;
    }
  }
  return Vec4(1.0F);
}

Vec3 evaluate(const Scene& scene, const ColourParameter& parameter, const TextureCoordinates& uv) {
  if (parameter.texture == kNoTexture) return parameter.value;
  return parameter.value * Vec3(evaluate_texture(scene, parameter.texture, uv));
}

float evaluate(const Scene& scene, const ScalarParameter& parameter, const TextureCoordinates& uv) {
  if (parameter.texture == kNoTexture) return parameter.value;
  return parameter.value * evaluate_texture(scene, parameter.texture, uv)[static_cast<int>(std::min(parameter.channel, 3U))];
}

float mean_luminance(const Scene& scene, const ColourParameter& parameter) {
  const float full = luminance(parameter.value);
  if (parameter.texture == kNoTexture) return full;
  constexpr int kSteps = 16;
  float sum = 0.0F;
  for (int y = 0; y < kSteps; ++y) {
    for (int x = 0; x < kSteps; ++x) {
      const Vec2 uv((static_cast<float>(x) + 0.5F) / kSteps, (static_cast<float>(y) + 0.5F) / kSteps);
      sum += luminance(evaluate(scene, parameter, uv));
    }
  }
  const float mean = sum / (kSteps * kSteps);
  return std::isfinite(mean) ? std::max(mean, 0.01F * full) : full;
}

}  // namespace grove
