#pragma once

#include <optional>

#include "grove/math/box.h"
#include "grove/scene/camera.h"

namespace grove {

/// A camera that is described rather than taken from a scene.
struct Viewpoint {
  std::optional<Vec3> eye;     ///< nothing: where all is in view
  std::optional<Vec3> target;  ///< nothing: the middle of what there is
  Vec3 up{0.0F, 1.0F, 0.0F};
  std::optional<float> field_of_view;  ///< radians from bottom to top; nothing: kUsualFieldOfView
};

/// The camera that `viewpoint` describes for a scene within `bounds` and a film of this aspect, turned about the axis through the target along `up`,
/// counter-clockwise seen from above, by `turns` whole turns. Throws UsageError when the eye is at the target, or the view along `up`.
[[nodiscard]] Camera camera_at(const Viewpoint& viewpoint, const Box& bounds, float aspect, double turns = 0.0);

}  // namespace grove
