#pragma once

#include <cstdint>

#include "grove/geometry/hit.h"
#include "grove/geometry/ray.h"
#include "grove/math/vector.h"
#include "grove/render/surface/surface_coordinates.h"
#include "grove/render/texture/texture_coordinates.h"

namespace grove {

/// A place on a surface, in world space: all that shading needs to know of the geometry.
struct SurfacePoint {
  Vec3 position{0.0F};
  /// Unit length, on the outer side: that of the vertex normals where there are any, else of the winding (counter-clockwise seen from
  /// outside) unless the part flips it; outward for spheres.
  Vec3 geometric_normal{0.0F, 0.0F, 1.0F};
  /// Unit length, on the same side.
  Vec3 shading_normal{0.0F, 0.0F, 1.0F};
  /// How position changes with (u, v); zeros where the texture coordinates say nothing.
  Vec3 dp_du{0.0F};
  Vec3 dp_dv{0.0F};
  /// The same with the second set of texture coordinates; those of the first where there is none.
  Vec3 second_dp_du{0.0F};
  Vec3 second_dp_dv{0.0F};
  /// A vertex tangent with the handedness of the bitangent in w; zeros where the mesh has none.
  Vec4 tangent{0.0F};
  Vec2 uv{0.0F};
  Vec2 second_uv{0.0F};
  Vec4 colour{1.0F};  ///< vertex colour
  std::uint32_t material = 0;
  /// Bounds how far rounding may have put `position` off the surface that traversal sees; see `offset_origin`.
  float error = 0.0F;

  [[nodiscard]] TextureCoordinates coordinates() const { return {uv, second_uv}; }
  [[nodiscard]] SurfaceCoordinates surface_coordinates() const { return {coordinates(), colour.w}; }

  /// An origin for a ray that leaves towards `direction`, moved along the geometric normal to the side that it leaves on, just far enough
  /// that traversal cannot find this surface again. The distance follows from the rounding errors of the coordinates at hand, not
  /// from the size of the scene (in the spirit of Wächter and Binder 2019, "A Fast and Robust Method for Avoiding Self-Intersection";
  /// unlike theirs it covers points near the origin and instance transforms).
  [[nodiscard]] Vec3 offset_origin(const Vec3& direction) const {
    return position + (glm::dot(direction, geometric_normal) < 0.0F ? -error : error) * geometric_normal;
  }
};

}  // namespace grove
