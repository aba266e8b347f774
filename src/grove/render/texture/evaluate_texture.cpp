#include "grove/render/texture/evaluate_texture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "grove/render/bsdf/bsdf_types.h"

namespace grove {
namespace {

// What bytes stand for: linear light by sRGB (IEC 61966-2-1), or the plain fraction of 255.
struct ByteTables {
  std::array<float, 256> srgb{};
  std::array<float, 256> plain{};
};

const ByteTables& byte_tables() {
  static const ByteTables tables = [] {
    ByteTables values;
    for (std::size_t i = 0; i < values.srgb.size(); ++i) {
      const double encoded = static_cast<double>(i) / 255.0;
      values.srgb[i] = static_cast<float>(encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4));
      values.plain[i] = static_cast<float>(i) / 255.0F;
    }
    return values;
  }();
  return tables;
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

Vec4 grey(float value, float alpha) {
  return {value, value, value, alpha};
}

// Texels of one image, by indices that are in it.
class Texels {
 public:
  Texels(const Image& image, const Texture& texture)
      : image_(image), plain_(byte_tables().plain.data()), colour_(texture.srgb ? byte_tables().srgb.data() : plain_) {}

  [[nodiscard]] Vec4 at(std::int64_t x, std::int64_t y) const {
    const std::size_t first = (static_cast<std::size_t>(y) * image_.width + static_cast<std::size_t>(x)) * image_.channels;
    if (image_.is_float()) {
      const float* const value = image_.floats.data() + first;
      if (image_.channels <= 2) return grey(value[0], image_.channels == 2 ? value[1] : 1.0F);
      return {value[0], value[1], value[2], image_.channels == 4 ? value[3] : 1.0F};
    }
    const std::uint8_t* const byte = image_.bytes.data() + first;
    if (image_.channels <= 2) return grey(colour_[byte[0]], image_.channels == 2 ? plain_[byte[1]] : 1.0F);
    return {colour_[byte[0]], colour_[byte[1]], colour_[byte[2]], image_.channels == 4 ? plain_[byte[3]] : 1.0F};
  }

  // One of the four numbers of `at`.
  [[nodiscard]] float channel(std::int64_t x, std::int64_t y, std::uint32_t channel) const {
    const bool is_alpha = channel == 3;
    const bool has_alpha = image_.channels == 2 || image_.channels == 4;
    if (is_alpha && !has_alpha) return 1.0F;
    const std::uint32_t place = is_alpha ? image_.channels - 1 : (image_.channels <= 2 ? 0 : channel);
    const std::size_t i = (static_cast<std::size_t>(y) * image_.width + static_cast<std::size_t>(x)) * image_.channels + place;
    if (image_.is_float()) return image_.floats[i];
    return (is_alpha ? plain_ : colour_)[image_.bytes[i]];
  }

 private:
  const Image& image_;
  const float* plain_;
  const float* colour_;
};

// std::floor without a call, for what fits into 63 bits.
std::int64_t whole_part(double value) {
  const auto truncated = static_cast<std::int64_t>(value);
  return static_cast<double>(truncated) > value ? truncated - 1 : truncated;
}

// Filters what `read` tells of texels, a Value for a column and a row; where there is nothing that is 0.
template <typename Value, typename Read>
Value filtered(const Image& image, const Texture& texture, const Vec2& uv, const Read& read) {
  const Value nothing(0.0F);
  // In double, so that far-off coordinates of repeated textures keep their place within a texel.
  const double x = static_cast<double>(uv.x) * image.width;
  const double y = static_cast<double>(uv.y) * image.height;
  constexpr double kFar = 1e15;  // beyond this a double has no fraction left
  if (!(std::fabs(x) < kFar && std::fabs(y) < kFar)) return nothing;
  if (texture.filter == TextureFilter::nearest) {
    std::int64_t column = whole_part(x);
    std::int64_t row = whole_part(y);
    if (!wrap(texture.wrap_u, image.width, column) || !wrap(texture.wrap_v, image.height, row)) return nothing;
    return read(column, row);
  }
  // Texel centres are at half-integers.
  std::int64_t left = whole_part(x - 0.5);
  std::int64_t top = whole_part(y - 0.5);
  const auto fx = static_cast<float>(x - 0.5 - static_cast<double>(left));
  const auto fy = static_cast<float>(y - 0.5 - static_cast<double>(top));
  std::int64_t right = left + 1;
  std::int64_t bottom = top + 1;
  const bool has_left = wrap(texture.wrap_u, image.width, left);
  const bool has_right = wrap(texture.wrap_u, image.width, right);
  const bool has_top = wrap(texture.wrap_v, image.height, top);
  const bool has_bottom = wrap(texture.wrap_v, image.height, bottom);
  const Value upper =
      (has_top && has_left ? read(left, top) : nothing) * (1.0F - fx) + (has_top && has_right ? read(right, top) : nothing) * fx;
  const Value lower = (has_bottom && has_left ? read(left, bottom) : nothing) * (1.0F - fx) +
                      (has_bottom && has_right ? read(right, bottom) : nothing) * fx;
  return upper * (1.0F - fy) + lower * fy;
}

bool has_texels(const Image& image) {
  return image.width > 0 && image.height > 0 && !(image.bytes.empty() && image.floats.empty());
}

Vec2 place_in(const Texture& texture, const TextureCoordinates& uv) {
  return Vec2(texture.uv_transform * Vec3(uv.of(texture.uv_set), 1.0F));
}

Vec4 evaluate_image(const Image& image, const Texture& texture, const Vec2& uv) {
  if (!has_texels(image)) return Vec4(0.0F);
  const Texels texels(image, texture);
  return filtered<Vec4>(image, texture, uv, [&](std::int64_t x, std::int64_t y) { return texels.at(x, y); });
}

// One channel of an image, as evaluate_texture has it.
float evaluate_channel(const Image& image, const Texture& texture, const Vec2& uv, std::uint32_t channel) {
  float value = 0.0F;
  if (has_texels(image)) {
    const Texels texels(image, texture);
    value = filtered<float>(image, texture, uv, [&](std::int64_t x, std::int64_t y) { return texels.channel(x, y, channel); });
  }
  return (texture.invert ? 1.0F - value : value) * texture.value[0][static_cast<int>(channel)];
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
      const Vec4 value = evaluate_image(*scene.images[texture.image], texture, place_in(texture, uv));
      return (texture.invert ? Vec4(1.0F) - value : value) * texture.value[0];
    }
    case TextureKind::checkerboard: {
      const Vec2 place = place_in(texture, uv);
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
  const std::uint32_t channel = std::min(parameter.channel, 3U);
  const Texture& texture = scene.textures[parameter.texture];
  if (texture.kind == TextureKind::image) {
    return parameter.value * evaluate_channel(*scene.images[texture.image], texture, place_in(texture, uv), channel);
  }
  return parameter.value * evaluate_texture(scene, parameter.texture, uv)[static_cast<int>(channel)];
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
