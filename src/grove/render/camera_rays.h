#pragma once

#include "grove/geometry/ray.h"
#include "grove/math/box.h"
#include "grove/scene/camera.h"

namespace grove {

/// Where something of the world is in a picture.
struct FilmPlace {
  Vec2 film{0.0F};     ///< pixels, (0, 0) the upper left corner of the picture
  float depth = 0.0F;  ///< along the viewing axis, world units; not positive behind the camera, where `film` means nothing
};

/// Rays of a camera for a film of a given size.
class CameraRays {
 public:
  /// Throws InputError when the camera's transform cannot be inverted or its field of view is not between 0 and pi.
  CameraRays(const Camera& camera, std::uint32_t width, std::uint32_t height);

  /// The ray through `film` (pixels, (0, 0) the upper left corner of the picture); `lens` in [0, 1)^2 chooses the point on a thin lens. The
  /// direction is of unit length.
  [[nodiscard]] Ray ray(const Vec2& film, const Vec2& lens) const;

  /// Whether `lens` matters.
  [[nodiscard]] bool has_lens() const { return lens_radius_ > 0.0F; }

  /// The other way, as a pinhole camera sees it: where a point of the world (w = 1) or what lies infinitely far in a direction (w = 0) is. O(1).
  [[nodiscard]] FilmPlace place(const Vec4& in_world) const;

  /// Whether both have the same rays.
  friend bool operator==(const CameraRays&, const CameraRays&) = default;

 private:
  Mat4 camera_to_world_;
  Mat4 world_to_camera_;
  Vec2 scale_;   // from pixels to the plane at z = -1
  Vec2 corner_;  // upper left, on that plane
  float lens_radius_;
  float focus_distance_;
};

/// About 34 degrees: little distortion.
inline constexpr float kUsualFieldOfView = 0.6F;

/// A view of the whole of `bounds` from above and a little to the side, +y up, for a film of this aspect (width over height); the field of view is in radians,
/// from bottom to top.
[[nodiscard]] Camera frame_bounds(const Box& bounds, float aspect, float field_of_view = kUsualFieldOfView);

}  // namespace grove
