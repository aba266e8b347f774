#pragma once

#include "grove/render/light/light_table.h"
#include "grove/render/material/material_table.h"
#include "grove/render/scene_accelerator.h"
#include "grove/render/surface/surface_table.h"

namespace grove {

/// A scene with all that integrators look up per ray. Refers to the scene and the accelerator; any number of threads may use it.
struct PreparedScene {
  PreparedScene(const Scene& source, const SceneAccelerator& structure, LightSampling sampling = LightSampling::hierarchy)
      : scene(source), accelerator(structure.top()), surfaces(source), materials(source), lights(source, surfaces, sampling) {}
  PreparedScene(const PreparedScene&) = delete;  // the tables refer to each other
  PreparedScene& operator=(const PreparedScene&) = delete;

  const Scene& scene;
  const Accelerator& accelerator;
  SurfaceTable surfaces;
  MaterialTable materials;
  LightTable lights;
};

}  // namespace grove
