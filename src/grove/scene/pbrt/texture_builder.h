#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "grove/scene/pbrt/context.h"
#include "grove/scene/pbrt/description.h"
#include "grove/scene/pbrt/spectrum.h"
#include "grove/scene/scene.h"

namespace grove::pbrt {

/// Turns Texture directives into Scene::textures and their files into Scene::images. Only textures that something refers to are made.
class TextureBuilder {
 public:
  /// Reads the images in parallel and makes the textures, in the order of their directives. An image that cannot be read becomes a grey
  /// texture with a warning.
  TextureBuilder(const Description& description, Scene& scene, Context& context);

  /// The texture of that name; where there is none a warning and kNoTexture. A texture of colours will do where numbers are asked for
  /// and the other way round, when it is the only one of the name.
  std::uint32_t find(const std::string& name, bool is_spectrum, const Place& place);

  /// A colour from the parameter `name`, which may be a texture.
  ColourParameter colour_parameter(const ParameterList& parameters, std::string_view name, const Vec3& otherwise, SpectrumUse use);
  /// The same for a number.
  ScalarParameter scalar_parameter(const ParameterList& parameters, std::string_view name, float otherwise);

  /// A texture with channel 0 of texture `id` raised to a power; exact but for `mix`, where the operands are raised.
  std::uint32_t raised_to_power(std::uint32_t id, float exponent);

  /// An image by the name that the scene file has for it, as a texture with v upward; kNoTexture with a warning when it cannot be read.
  std::uint32_t image_texture(const std::string& file, bool srgb, const Place& place);
  /// The image itself, which is not put into the scene. Throws InputError when it cannot be read.
  std::shared_ptr<const Image> image(const std::string& file);

 private:
  struct LoadedImage {
    std::shared_ptr<const Image> image;
    std::string problem;
    std::uint32_t id = kNone;
  };

  std::vector<bool> used_textures() const;
  void read_images(const std::vector<bool>& used);
  LoadedImage& load(const std::string& file);
  std::uint32_t add_image(LoadedImage& loaded);

  Texture make(const TextureDirective& directive);
  Texture make_image(const TextureDirective& directive);
  Texture make_stand_in(const TextureDirective& directive);
  /// Operand `i` of a texture from the parameter `name`, which may be a texture too.
  void set_operand(Texture& texture, int i, const TextureDirective& directive, std::string_view name, float otherwise, bool is_spectrum);
  void set_amount(Texture& texture, const TextureDirective& directive, std::string_view name);
  void set_mapping(Texture& texture, const TextureDirective& directive, bool v_down);
  /// Replaces a texture that stands for too many evaluations.
  void limit_cost(Texture& texture, const Place& place);
  std::uint32_t raised_image(const Texture& texture, float exponent);

  const Description& description_;
  Scene& scene_;
  Context& context_;
  std::map<std::string, LoadedImage> images_;
  // By name, the Scene texture; the last of several directives.
  std::map<std::string, std::uint32_t, std::less<>> numbers_;
  std::map<std::string, std::uint32_t, std::less<>> colours_;
  std::map<std::pair<std::uint32_t, float>, std::uint32_t> raised_;
  std::vector<std::uint32_t> costs_;  // evaluations that each Scene texture stands for
};

}  // namespace grove::pbrt
