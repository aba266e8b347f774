#include "grove/render/texture/evaluate_texture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "grove/render/bsdf/bsdf_types.h"

namespace grove {
namespace {

using ByteTable = std::array<float, 256>;

// 8-bit sRGB to linear (IEC 61966-2-1).
const ByteTable& srgb_table() {
  static const ByteTable table = [] {
    ByteTable values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double encoded = static_cast<double>(i) / 255.0;
      values[i] = static_cast<float>(encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4));
    }
    return values;
  }();
  return table;
}

constexpr ByteTable kLinearTable = [] {
  ByteTable values{};
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i) / 255.0F;
  return values;
}();

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

// One channel of an image's texels as RGBA.
class ChannelReader {
 public:
  using Value = float;

  ChannelReader(const Image& image, const Texture& texture, std::uint32_t channel) : image_(&image) {
    const bool has_alpha = image.channels == 2 || image.channels == 4;
    is_there_ = channel < 3 || has_alpha;
    if (is_there_) offset_ = channel == 3 ? image.channels - 1 : (image.channels < 3 ? 0 : channel);
    table_ = texture.srgb && channel < 3 ? srgb_table().data() : kLinearTable.data();
  }

  [[nodiscard]] float operator()(std::size_t texel) const {
    if (!is_there_) return 1.0F;
    const std::size_t place = texel * image_->channels + offset_;
    return image_->is_float() ? image_->floats[place] : table_[image_->bytes[place]];
  }

 private:
  const Image* image_;
  const float* table_;
  std::uint32_t offset_ = 0;
  bool is_there_;
};

// All four.
class TexelReader {
 public:
  using Value = Vec4;

  TexelReader(const Image& image, const Texture& texture)
      : red_{image, texture, 0}, green_{image, texture, 1}, blue_{image, texture, 2}, alpha_{image, texture, 3} {}

  [[nodiscard]] Vec4 operator()(std::size_t texel) const { return {red_(texel), green_(texel), blue_(texel), alpha_(texel)}; }

 private:
  ChannelReader red_, green_, blue_, alpha_;
};

template <typename Reader>
typename Reader::Value texel(const Image& image, const Texture& texture, const Reader& reader, std::int64_t x, std::int64_t y) {
  if (!wrap(texture.wrap_u, image.width, x) || !wrap(texture.wrap_v, image.height, y)) return typename Reader::Value(0.0F);
  return reader(static_cast<std::size_t>(y) * image.width + static_cast<std::size_t>(x));
}

// `place` is in the coordinates of the image.
template <typename Reader>
typename Reader::Value evaluate_image(const Image& image, const Texture& texture, const Reader& reader, const Vec2& place) {
  using Value = typename Reader::Value;
  if (image.width == 0 || image.height == 0 || (image.bytes.empty() && image.floats.empty())) return Value(0.0F);
  // In double, so that far-off coordinates of repeated textures keep their place within a texel.
  const double x = static_cast<double>(place.x) * image.width;
  const double y = static_cast<double>(place.y) * image.height;
  constexpr double kFar = 1e15;  // beyond this a double has no fraction left
  if (!(std::fabs(x) < kFar && std::fabs(y) < kFar)) return Value(0.0F);
  if (texture.filter == TextureFilter::nearest) {
    return texel(image, texture, reader, static_cast<std::int64_t>(std::floor(x)), static_cast<std::int64_t>(std::floor(y)));
  }
  // Texel centres are at half-integers.
  const double left = std::floor(x - 0.5);
  const double top = std::floor(y - 0.5);
  const auto fx = static_cast<float>(x - 0.5 - left);
  const auto fy = static_cast<float>(y - 0.5 - top);
  const auto x0 = static_cast<std::int64_t>(left);
  const auto y0 = static_cast<std::int64_t>(top);
  const Value upper = texel(image, texture, reader, x0, y0) * (1.0F - fx) + texel(image, texture, reader, x0 + 1, y0) * fx;
  const Value lower = texel(image, texture, reader, x0, y0 + 1) * (1.0F - fx) + texel(image, texture, reader, x0 + 1, y0 + 1) * fx;
  return upper * (1.0F - fy) + lower * fy;
}

Vec2 place_in(const Texture& texture, const TextureCoordinates& uv) {
  return Vec2(texture.uv_transform * Vec3(uv.of(texture.uv_set), 1.0F));
}

// Most numbers are one channel of a picture, of which the others need not be read.
float evaluate_channel(const Scene& scene, std::uint32_t texture_id, std::uint32_t channel, const TextureCoordinates& uv) {
  const Texture& texture = scene.textures[texture_id];
  if (texture.kind != TextureKind::image) return evaluate_texture(scene, texture_id, uv)[static_cast<int>(channel)];
  const Image& image = *scene.images[texture.image];
  const float value = evaluate_image(image, texture, ChannelReader(image, texture, channel), place_in(texture, uv));
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
      const Image& image = *scene.images[texture.image];
      const Vec4 value = evaluate_image(image, texture, TexelReader(image, texture), place_in(texture, uv));
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
  return parameter.value * evaluate_channel(scene, parameter.texture, std::min(parameter.channel, 3U), uv);
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
