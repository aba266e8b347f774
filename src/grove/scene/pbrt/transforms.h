#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "grove/math/vector.h"

namespace grove::pbrt {

/// Transforms are composed in double, so that long chains of directives do not wear the coordinates down.
using Matrix = glm::dmat4;

[[nodiscard]] Matrix translation(const glm::dvec3& by);
[[nodiscard]] Matrix scaling(const glm::dvec3& by);
/// Counter-clockwise about `axis` (any length; a zero axis gives NaN) as seen from its tip.
[[nodiscard]] Matrix rotation(double degrees, const glm::dvec3& axis);
/// World to camera as pbrt's LookAt has it: +x right, +y up, +z into the picture, so left-handed. NaN when the view has no direction.
[[nodiscard]] Matrix look_at_matrix(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up);

/// The inverse of an affine map, whose last row stays exactly 0 0 0 1. Not finite when the map cannot be inverted.
[[nodiscard]] Matrix affine_inverse(const Matrix& m);

/// True when every entry is finite, and fits a float.
[[nodiscard]] bool is_finite(const Matrix& m);
/// True when the map turns a left hand into a right hand.
[[nodiscard]] bool is_mirrored(const Matrix& m);
/// True when the map is affine, finite and can be inverted: what shapes and lights need.
[[nodiscard]] bool is_usable(const Matrix& m);

[[nodiscard]] Vec3 transform_point(const Matrix& m, const Vec3& p);
[[nodiscard]] Vec3 transform_vector(const Matrix& m, const Vec3& v);

}  // namespace grove::pbrt
