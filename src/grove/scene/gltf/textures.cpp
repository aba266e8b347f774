#include "grove/scene/gltf/textures.h"

#include <cmath>
#include <string>

#include "grove/base/error.h"
#include "grove/scene/read_image.h"

namespace grove {
namespace {

constexpr std::uint64_t kNearest = 9728;
constexpr std::uint64_t kClampToEdge = 33071;
constexpr std::uint64_t kMirroredRepeat = 33648;
constexpr std::uint64_t kRepeat = 10497;

TextureWrap read_wrap(const JsonCursor& place) {
  switch (place.whole(kRepeat)) {
    case kRepeat:
      return TextureWrap::repeat;
    case kMirroredRepeat:
      return TextureWrap::mirror;
    case kClampToEdge:
      return TextureWrap::clamp;
    default:
      place.fail("is not a wrapping mode");
  }
}

// KHR_texture_transform: scale, then rotate anticlockwise as the image is seen (v points down), then move.
Mat3 read_transform(const JsonCursor& transform) {
  const Vec2 offset = transform["offset"].vec2(Vec2(0.0F));
  const Vec2 scale = transform["scale"].vec2(Vec2(1.0F));
  const double angle = transform["rotation"].number(0.0);
  const auto c = static_cast<float>(std::cos(angle));
  const auto s = static_cast<float>(std::sin(angle));
  return {Vec3(c, -s, 0.0F) * scale.x, Vec3(s, c, 0.0F) * scale.y, Vec3(offset, 1.0F)};
}

}  // namespace

std::uint32_t GltfTextures::add(const JsonCursor& info, TextureUse use) {
  if (!info.exists()) return kNoTexture;
  const JsonCursor transform = info.extension("KHR_texture_transform");
  const std::uint64_t uv_set = transform["texCoord"].whole(info["texCoord"].whole(0));
  if (uv_set > 1 && document_.is_first("texture coordinates")) {
    scene_.warn("textures that use sets of texture coordinates beyond TEXCOORD_1 are shown with TEXCOORD_0, such as " + info.path());
  }
  const std::uint32_t known_set = uv_set == 1 ? 1 : 0;
  const JsonCursor textures = document_.array("textures");
  const std::uint32_t id = info["index"].required_index(textures.size(), "textures");
  if (!transform.exists()) {
    const auto found = textures_.find({id, use, known_set});
    if (found != textures_.end()) return found->second;
  }

  const JsonCursor description = textures.element(id);
  Texture texture;
  texture.name = description["name"].text();
  texture.kind = TextureKind::image;
  texture.srgb = use == TextureUse::colour;
  texture.uv_set = known_set;
  if (transform.exists()) texture.uv_transform = read_transform(transform);
  set_sampler(description, texture);
  const auto source = description["source"].index(document_.array("images").size(), "images");
  if (!source && document_.is_first("textures without images")) {
    scene_.warn("textures without an image of a known format are left out, such as " + description.path());
  }
  std::uint32_t result = kNoTexture;
  if (source) texture.image = image(*source);
  if (source && texture.image != kNoTexture) {
    result = static_cast<std::uint32_t>(scene_.textures.size());
    scene_.textures.push_back(std::move(texture));
  }
  if (!transform.exists()) textures_[{id, use, known_set}] = result;
  return result;
}

void GltfTextures::set_sampler(const JsonCursor& texture, Texture& result) {
  const JsonCursor samplers = document_.array("samplers");
  const auto id = texture["sampler"].index(samplers.size(), "samplers");
  if (!id) return;
  const JsonCursor sampler = samplers.element(*id);
  result.wrap_u = read_wrap(sampler["wrapS"]);
  result.wrap_v = read_wrap(sampler["wrapT"]);
  if (sampler["magFilter"].whole(0) == kNearest) result.filter = TextureFilter::nearest;
}

std::uint32_t GltfTextures::image(std::uint32_t id) {
  const auto found = images_.find(id);
  if (found != images_.end()) return found->second;
  const JsonCursor description = document_.array("images").element(id);
  std::uint32_t result = kNoTexture;
  try {
    scene_.images.push_back(decode(description));
    result = static_cast<std::uint32_t>(scene_.images.size() - 1);
  } catch (const InputError& error) {
    scene_.warn("a texture is left out: " + std::string(error.what()));
  }
  images_[id] = result;
  return result;
}

std::shared_ptr<const Image> GltfTextures::decode(const JsonCursor& description) {
  const std::string name = document_.file() + ":" + description.path();
  Image image;
  if (description["bufferView"].exists()) {
    const std::uint32_t view = description["bufferView"].required_index(document_.array("bufferViews").size(), "buffer views");
    image = decode_image(document_.view(view), name);
  } else if (description["uri"].exists()) {
    image = decode_image(document_.read_uri(description["uri"]), name);
  } else {
    description.fail("has neither a uri nor a bufferView");
  }
  return std::make_shared<const Image>(std::move(image));
}

}  // namespace grove
