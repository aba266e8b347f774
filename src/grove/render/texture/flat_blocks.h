#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "grove/render/texture/texture_coordinates.h"
#include "grove/scene/scene.h"

namespace grove {

/// Where one channel of a picture is 0 throughout, or 1: most of the alpha of leaves and fences. The blocks of such a table stay in near caches where the
/// texels of the picture, met at random, do not.
class FlatBlocks {
 public:
  /// Reads the whole picture. A byte for 64 texels is kept; nothing for pictures of floats, textures that are no picture, and channels that are nowhere flat.
  /// Refers to the scene, which must be valid.
  FlatBlocks(const Scene& scene, const ScalarParameter& parameter);

  /// `evaluate` of the parameter at `uv`, bit for bit, where its texture is flat around there. O(1); any number of threads may ask.
  [[nodiscard]] std::optional<float> evaluate(const TextureCoordinates& uv) const;

 private:
  enum class Block : std::uint8_t { varies, zero, one };

  static constexpr std::uint32_t kSide = 8;

  const Scene* scene_;
  ScalarParameter parameter_;
  std::uint32_t columns_ = 0;
  std::vector<Block> blocks_;  // by rows, or empty
};

}  // namespace grove
