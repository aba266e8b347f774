#pragma once

#include "grove/scene/pbrt/context.h"
#include "grove/scene/pbrt/description.h"
#include "grove/scene/pbrt/material_builder.h"
#include "grove/scene/scene.h"

namespace grove::pbrt {

/// Turns shapes into Scene::objects and Scene::instances. Shapes outside object definitions, and those of definitions that are used once,
/// make one object of triangles and one of spheres in world space; a definition used more often makes its own, with an instance per use;
/// one that is never used makes nothing. Shapes are read and tessellated in parallel; the result does not depend on the number of threads.
void build_objects(const Description& description, MaterialBuilder& materials, Scene& scene, Context& context);

}  // namespace grove::pbrt
