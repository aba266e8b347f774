#include "grove/scene/animation/affine.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "grove/math/to_float.h"

namespace grove {

glm::dmat4 compose_transform(const glm::dvec3& translation, const glm::dvec4& rotation, const glm::dvec3& scale) {
  glm::dmat4 m(1.0);
  // Exporters round, so that a quaternion is rarely of unit length exactly.
  const double length = glm::length(rotation);
  if (length > 0.0) {
    const auto [x, y, z, w] = std::array{rotation.x / length, rotation.y / length, rotation.z / length, rotation.w / length};
    m[0] = {1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w), 0.0};
    m[1] = {2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w), 0.0};
    m[2] = {2.0 * (x * z + y * w), 2.0 * (y * z - x * w), 1.0 - 2.0 * (x * x + y * y), 0.0};
  }
  for (int axis = 0; axis < 3; ++axis) m[axis] *= scale[axis];
  m[3] = glm::dvec4(translation, 1.0);
  return m;
}

Mat4 to_single(const glm::dmat4& matrix) {
  Mat4 m;
  for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = to_float(matrix[i / 4][i % 4]);
  return m;
}

bool is_finite(const Mat4& matrix) {
  for (int i = 0; i < 16; ++i) {
    if (!std::isfinite(matrix[i / 4][i % 4])) return false;
  }
  return true;
}

bool same_bits(const Mat4& a, const Mat4& b) {
  for (int i = 0; i < 16; ++i) {
    if (std::bit_cast<std::uint32_t>(a[i / 4][i % 4]) != std::bit_cast<std::uint32_t>(b[i / 4][i % 4])) return false;
  }
  return true;
}

Mat3 normal_matrix(const Mat4& matrix) {
  const Vec3 x(matrix[0]);
  const Vec3 y(matrix[1]);
  const Vec3 z(matrix[2]);
  const Mat3 cofactors(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
  // The inverse transpose is the cofactors over the determinant.
  return glm::dot(x, cofactors[0]) < 0.0F ? -cofactors : cofactors;
}

}  // namespace grove
