#pragma once

#include <cstdint>

#include "grove/render/texture/texture_coordinates.h"
#include "grove/scene/scene.h"

namespace grove {

/// The linear RGBA value of a texture of `scene` at `uv`, by the set of coordinates that it names; kNoTexture gives ones. Images are filtered bilinearly (or not at all), their
/// colour decoded before the filter; grey images give the grey in R, G and B; images without alpha give 1 there. Images without pixels
/// and coordinates that are not finite give zeros. The scene must be valid.
[[nodiscard]] Vec4 evaluate_texture(const Scene& scene, std::uint32_t texture, const TextureCoordinates& uv);

/// A colour times its texture.
[[nodiscard]] Vec3 evaluate(const Scene& scene, const ColourParameter& parameter, const TextureCoordinates& uv);

/// A number times its texture's channel.
[[nodiscard]] float evaluate(const Scene& scene, const ScalarParameter& parameter, const TextureCoordinates& uv);

/// About the mean luminance of a colour over its texture, never 0 unless the colour is black: for the choice of lights.
[[nodiscard]] float mean_luminance(const Scene& scene, const ColourParameter& parameter);

}  // namespace grove
