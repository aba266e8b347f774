#pragma once

#include "grove/render/bsdf/bsdf.h"
#include "grove/render/light/light_receiver.h"
#include "grove/render/prepared_scene.h"
#include "grove/render/surface/frame.h"

namespace grove {

/// A surface point as a viewer sees it: its local frame, turned to the viewer's side, and how it scatters.
struct ShadingPoint {
  Frame frame;
  Vec3 wo{0.0F};                ///< local, wo.z > 0
  Vec3 facing_geometric{0.0F};  ///< geometric normal on the viewer's side, world
  Bsdf bsdf;

  /// `to_viewer` is of unit length; `u` decides between the materials of a mix.
  ShadingPoint(const PreparedScene& world, const SurfacePoint& point, const Vec3& to_viewer, float u);

  /// How lights are to be chosen for `point`, the place that this was made of. Sampling a light and weighing one that was hit must both go by it.
  [[nodiscard]] LightReceiver receiver(const SurfacePoint& point) const {
    return {point.position, facing_geometric, bsdf.reflects_only() ? LightReceiver::Side::front : LightReceiver::Side::both};
  }

  /// Whether a world direction with these local coordinates leaves on the same side of the true surface as of the shading normal's. Others
  /// would leak light through the surface.
  [[nodiscard]] bool is_consistent(const Vec3& world_direction, const Vec3& local) const {
    return (glm::dot(world_direction, facing_geometric) > 0.0F) == (local.z > 0.0F);
  }
};

}  // namespace grove
