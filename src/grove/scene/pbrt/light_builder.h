#pragma once

#include "grove/scene/pbrt/texture_builder.h"

namespace grove::pbrt {

/// Turns LightSource directives into Scene::lights and Scene::environment, in pbrt-v4's units: rgb (1, 1, 1) is a radiance, intensity or
/// irradiance of 1 in the picture, and a spectrum or black body is scaled to luminance 1 first.
void build_lights(const Description& description, TextureBuilder& textures, Scene& scene, Context& context);

}  // namespace grove::pbrt
