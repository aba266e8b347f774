#pragma once

#include "grove/render/light/light_table.h"
#include "grove/render/material/material_table.h"
#include "grove/render/scene_accelerator.h"
#include "grove/render/surface/surface_table.h"
#include "grove/scene/animation/scene_changes.h"

namespace grove {

/// A scene with all that integrators look up per ray. Refers to the scene and the accelerator; any number of threads may use it.
struct PreparedScene {
  PreparedScene(const Scene& source, const SceneAccelerator& structure, LightSampling sampling = LightSampling::hierarchy)
      : scene(source), accelerator(structure.top()), surfaces(source), materials(source), lights(source, surfaces, sampling) {}
  PreparedScene(const PreparedScene&) = delete;  // the tables refer to each other
  PreparedScene& operator=(const PreparedScene&) = delete;

  /// Follows the scene after it has moved as `changes` says: afterwards all is as if made anew, bit for bit. Materials and the picture of the environment do not move and are kept; surfaces are laid
  /// out again where geometry moved, O(instances + parts), and lights are gathered again where they or what shines moved, O(lights log lights). Not while others use it.
  void follow(const SceneChanges& changes);

  const Scene& scene;
  const Accelerator& accelerator;
  SurfaceTable surfaces;
  MaterialTable materials;
  LightTable lights;
};

}  // namespace grove
