#include "grove/render/texture/flat_blocks.h"

#include <algorithm>
#include <cmath>

namespace grove {
namespace {

// Brings a texel index into [0, size) where textures are repeated. False outside of the picture otherwise, and where doubles begin to lose digits.
bool find_texel(TextureWrap mode, std::uint32_t size, double place, std::uint32_t& index) {
  if (!(std::fabs(place) < 1e14)) return false;
  if (mode == TextureWrap::repeat) place -= std::floor(place / size) * size;
  if (!(place >= 0.0 && place < size)) return false;
  index = static_cast<std::uint32_t>(place);
  return true;
}

}  // namespace

FlatBlocks::FlatBlocks(const Scene& scene, const ScalarParameter& parameter) : scene_(&scene), parameter_(parameter) {
  if (parameter.texture == kNoTexture || scene.textures[parameter.texture].kind != TextureKind::image) return;
  const Image& image = *scene.images[scene.textures[parameter.texture].image];
  const bool has_alpha = image.channels == 2 || image.channels == 4;
  const std::uint32_t channel = std::min(parameter.channel, 3U);
  if (image.bytes.empty() || (channel == 3 && !has_alpha)) return;
  const std::uint32_t offset = channel == 3 ? image.channels - 1 : (image.channels < 3 ? 0 : channel);
  columns_ = (image.width + kSide - 1) / kSide;
  const std::uint32_t rows = (image.height + kSide - 1) / kSide;
  blocks_.assign(std::size_t{columns_} * rows, Block::varies);
  bool is_any_flat = false;
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t column = 0; column < columns_; ++column) {
      // With the texels behind the last, which are blended with it. Where there are none another part of the picture is: such blocks are left alone.
      const std::uint32_t end_x = (column + 1) * kSide + 1;
      const std::uint32_t end_y = (row + 1) * kSide + 1;
      if (end_x > image.width || end_y > image.height) continue;
      const auto texel = [&](std::uint32_t x, std::uint32_t y) {
        return image.bytes[(std::size_t{y} * image.width + x) * image.channels + offset];
      };
      const std::uint8_t first = texel(column * kSide, row * kSide);
      bool is_flat = first == 0 || first == 255;
      for (std::uint32_t y = row * kSide; y < end_y && is_flat; ++y)
        for (std::uint32_t x = column * kSide; x < end_x && is_flat; ++x) is_flat = texel(x, y) == first;
      if (is_flat) blocks_[std::size_t{row} * columns_ + column] = first == 0 ? Block::zero : Block::one;
      is_any_flat = is_any_flat || is_flat;
    }
  }
  if (!is_any_flat) blocks_.clear();
}

std::optional<float> FlatBlocks::evaluate(const TextureCoordinates& uv) const {
  if (blocks_.empty()) return std::nullopt;
  const Texture& texture = scene_->textures[parameter_.texture];
  const Image& image = *scene_->images[texture.image];
  const Vec2 place = Vec2(texture.uv_transform * Vec3(uv.of(texture.uv_set), 1.0F));
  const double half = texture.filter == TextureFilter::nearest ? 0.0 : 0.5;
  std::uint32_t x = 0;
  std::uint32_t y = 0;
  if (!find_texel(texture.wrap_u, image.width, std::floor(static_cast<double>(place.x) * image.width - half), x) ||
      !find_texel(texture.wrap_v, image.height, std::floor(static_cast<double>(place.y) * image.height - half), y))
    return std::nullopt;
  const Block block = blocks_[std::size_t{y / kSide} * columns_ + x / kSide];
  if (block == Block::varies) return std::nullopt;
  // Zeros and ones stay what they are when they are decoded and blended, without rounding.
  const float value = block == Block::one ? 1.0F : 0.0F;
  return parameter_.value *
         ((texture.invert ? 1.0F - value : value) * texture.value[0][static_cast<int>(std::min(parameter_.channel, 3U))]);
}

}  // namespace grove
