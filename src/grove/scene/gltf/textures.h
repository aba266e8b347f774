#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <tuple>

#include "grove/scene/gltf/document.h"
#include "grove/scene/scene.h"

namespace grove {

/// What a texture's numbers mean.
enum class TextureUse : std::uint8_t { colour, data };

/// Turns the textures that materials name into the scene's, decoding each image once, when first used. An image that cannot be read
/// costs a warning, and the material keeps its factor.
class GltfTextures {
 public:
  GltfTextures(GltfDocument& document, Scene& scene) : document_(document), scene_(scene) {}

  /// The scene's texture for a textureInfo object; kNoTexture when there is none or it cannot be used.
  [[nodiscard]] std::uint32_t add(const JsonCursor& info, TextureUse use);

 private:
  std::uint32_t image(std::uint32_t id);
  std::shared_ptr<const Image> decode(const JsonCursor& description);
  void set_sampler(const JsonCursor& texture, Texture& result);

  GltfDocument& document_;
  Scene& scene_;
  /// By glTF image number; kNoTexture for those that cannot be read.
  std::map<std::uint32_t, std::uint32_t> images_;
  /// By glTF texture number, use and set of coordinates, for those without a transform.
  std::map<std::tuple<std::uint32_t, TextureUse, std::uint32_t>, std::uint32_t> textures_;
};

}  // namespace grove
