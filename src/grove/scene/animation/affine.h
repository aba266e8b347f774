#pragma once

#include "grove/math/vector.h"

namespace grove {

/// Translation after rotation (a quaternion x, y, z, w of any length; zero turns nothing) after scale.
[[nodiscard]] glm::dmat4 compose_transform(const glm::dvec3& translation, const glm::dvec4& rotation, const glm::dvec3& scale);

/// Each number as the nearest float, or an infinity beyond their range.
[[nodiscard]] Mat4 to_single(const glm::dmat4& matrix);

/// Whether all 16 numbers are finite.
[[nodiscard]] bool is_finite(const Mat4& matrix);

/// Whether all 16 numbers have the same bits, so that a matrix that is not a number is equal to itself.
[[nodiscard]] bool same_bits(const Mat4& a, const Mat4& b);

/// Inverse transpose of a linear map but for a factor: its cofactors, which exist for singular maps too. The sign keeps normals on their
/// side under reflections: n is taken to the normal of the transformed surface whose front is the transformed front.
[[nodiscard]] Mat3 normal_matrix(const Mat4& matrix);

}  // namespace grove
