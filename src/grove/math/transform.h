#pragma once

#include "grove/math/box.h"
#include "grove/math/vector.h"

namespace grove {

/// An affine map with its inverse, both kept so that points and normals go either way without a solve.
class Transform {
 public:
  /// The identity.
  Transform() = default;

  /// `matrix` must be affine (last row 0 0 0 1). A singular or non-finite matrix is allowed and makes `is_invertible()` false.
  explicit Transform(const Mat4& matrix);

  [[nodiscard]] const Mat4& matrix() const { return matrix_; }
  [[nodiscard]] const Mat4& inverse_matrix() const { return inverse_; }
  [[nodiscard]] bool is_identity() const { return identity_; }
  [[nodiscard]] bool is_invertible() const { return invertible_; }

  [[nodiscard]] Vec3 point(const Vec3& p) const { return Vec3(matrix_ * Vec4(p, 1.0F)); }
  [[nodiscard]] Vec3 vector(const Vec3& v) const { return Vec3(matrix_ * Vec4(v, 0.0F)); }
  /// Transforms a normal by the inverse transpose; the result is not normalised.
  [[nodiscard]] Vec3 normal(const Vec3& n) const { return glm::transpose(Mat3(inverse_)) * n; }
  [[nodiscard]] Vec3 inverse_point(const Vec3& p) const { return Vec3(inverse_ * Vec4(p, 1.0F)); }
  [[nodiscard]] Vec3 inverse_vector(const Vec3& v) const { return Vec3(inverse_ * Vec4(v, 0.0F)); }

  /// A box that encloses the transformed box, rounded outward. Empty stays empty.
  [[nodiscard]] Box box(const Box& b) const;

 private:
  Mat4 matrix_{1.0F};
  Mat4 inverse_{1.0F};
  bool identity_ = true;
  bool invertible_ = true;
};

}  // namespace grove
