#include "grove/scene/pbrt/transforms.h"

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace grove::pbrt {

Matrix translation(const glm::dvec3& by) {
  Matrix m(1.0);
  m[3] = glm::dvec4(by, 1.0);
  return m;
}

Matrix scaling(const glm::dvec3& by) {
  Matrix m(1.0);
  for (int axis = 0; axis < 3; ++axis) m[axis][axis] = by[axis];
  return m;
}

// Rodrigues' formula, column by column: R e = e cos + (a x e) sin + a (a . e) (1 - cos).
Matrix rotation(double degrees, const glm::dvec3& axis) {
  const double angle = degrees * (3.14159265358979323846 / 180.0);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const glm::dvec3 a = axis / std::sqrt(glm::dot(axis, axis));
  Matrix m(1.0);
  for (int column = 0; column < 3; ++column) {
    glm::dvec3 e(0.0);
    e[column] = 1.0;
    m[column] = glm::dvec4(e * c + glm::cross(a, e) * s + a * (a[column] * (1.0 - c)), 0.0);
  }
  return m;
}

Matrix look_at_matrix(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up) {
  const glm::dvec3 forward = glm::normalize(target - eye);
  const glm::dvec3 right = glm::normalize(glm::cross(glm::normalize(up), forward));
  const glm::dvec3 true_up = glm::cross(forward, right);
  Matrix camera_to_world(1.0);
  camera_to_world[0] = glm::dvec4(right, 0.0);
  camera_to_world[1] = glm::dvec4(true_up, 0.0);
  camera_to_world[2] = glm::dvec4(forward, 0.0);
  camera_to_world[3] = glm::dvec4(eye, 1.0);
  return affine_inverse(camera_to_world);
}

Matrix affine_inverse(const Matrix& m) {
  const glm::dmat3 linear = glm::inverse(glm::dmat3(m));
  Matrix inverse(linear);
  inverse[3] = glm::dvec4(-(linear * glm::dvec3(m[3])), 1.0);
  return inverse;
}

bool is_finite(const Matrix& m) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!(std::abs(m[column][row]) <= std::numeric_limits<float>::max())) return false;
    }
  }
  return true;
}

bool is_mirrored(const Matrix& m) {
  return glm::determinant(glm::dmat3(m)) < 0.0;
}

bool is_usable(const Matrix& m) {
  if (!is_finite(m) || m[0][3] != 0.0 || m[1][3] != 0.0 || m[2][3] != 0.0 || m[3][3] != 1.0) return false;
  const double determinant = glm::determinant(glm::dmat3(m));
  return std::isfinite(determinant) && determinant != 0.0;
}

Vec3 transform_point(const Matrix& m, const Vec3& p) {
  return Vec3(glm::dvec3(m * glm::dvec4(p, 1.0)));
}

Vec3 transform_vector(const Matrix& m, const Vec3& v) {
  return Vec3(glm::dvec3(m * glm::dvec4(v, 0.0)));
}

}  // namespace grove::pbrt
