#pragma once

#include "grove/scene/pbrt/context.h"
#include "grove/scene/pbrt/description.h"
#include "grove/scene/scene.h"

namespace grove::pbrt {

/// Turns the Camera and Film directives into Scene::cameras and Scene::film. Where they are missing the scene says nothing either.
void build_camera(const Description& description, Scene& scene, Context& context);

}  // namespace grove::pbrt
