#pragma once

#include <cstdint>
#include <string>

#include "grove/math/vector.h"

namespace grove {

/// Which extent of the picture the field of view spans.
enum class FieldOfViewAxis : std::uint8_t { vertical, horizontal, smaller };

/// A perspective camera. In its own space it looks along -z with +y up and +x right, as in glTF.
struct Camera {
  std::string name;
  /// May hold a reflection (left-handed files); must be invertible.
  Mat4 camera_to_world{1.0F};
  float field_of_view = 0.8F;  ///< radians, the full angle
  FieldOfViewAxis axis = FieldOfViewAxis::vertical;
  float lens_radius = 0.0F;  ///< world units; 0 is a pinhole
  float focus_distance = 1.0F;
};

/// A camera at `eye` looking at `target`; `up` must not be parallel to the view.
[[nodiscard]] Camera look_at(const Vec3& eye, const Vec3& target, const Vec3& up, float field_of_view);

}  // namespace grove
