#pragma once

#include <cstdint>
#include <string>

#include "grove/math/vector.h"

namespace grove {

inline constexpr std::uint32_t kNoTexture = 0xffffffffU;

enum class TextureKind : std::uint8_t {
  constant,      ///< value[0]
  image,         ///< image, times value[0]
  checkerboard,  ///< operand 0 and 1 by turns
  scale,         ///< operand 0 times operand 1
  mix            ///< operand 0 * (1 - amount) + operand 1 * amount
};

enum class TextureWrap : std::uint8_t { repeat, mirror, clamp, black };
enum class TextureFilter : std::uint8_t { linear, nearest };

/// A function of (u, v) with values RGBA. Texture coordinates: v = 0 is the top row of the image (glTF's way); loaders of formats with
/// v upward put the turn-over into `uv_transform`.
/// The operands of checkerboard, scale and mix are textures of a lower number (so there is no cycle) or, where that is kNoTexture, value[i].
struct Texture {
  std::string name;
  TextureKind kind = TextureKind::constant;
  std::uint32_t image = 0xffffffffU;  ///< index into Scene::images
  bool srgb = false;                  ///< 8-bit colour channels are sRGB-encoded (alpha never is)
  bool invert = false;                ///< image: 1 - value
  TextureWrap wrap_u = TextureWrap::repeat;
  TextureWrap wrap_v = TextureWrap::repeat;
  TextureFilter filter = TextureFilter::linear;
  std::uint32_t uv_set = 0;  ///< 0: Part::uvs, 1: Part::second_uvs
  /// Applied to (u, v, 1).
  Mat3 uv_transform{1.0F};
  std::uint32_t operand[2] = {kNoTexture, kNoTexture};
  Vec4 value[2] = {Vec4(1.0F), Vec4(1.0F)};
  std::uint32_t amount_texture = kNoTexture;
  float amount = 0.5F;
};

}  // namespace grove
