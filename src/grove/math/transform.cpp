#include "grove/math/transform.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grove {

Transform::Transform(const Mat4& matrix) : matrix_(matrix), identity_(matrix == Mat4(1.0F)) {
  // Inverted in double: scales of 1e-6 and less are common in converted scenes and their determinants underflow a float.
  const glm::dmat4 inverse = glm::inverse(glm::dmat4(matrix));
  inverse_ = Mat4(inverse);
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      invertible_ = invertible_ && std::isfinite(matrix_[column][row]) && std::isfinite(inverse_[column][row]);
}

Box Transform::box(const Box& b) const {
  if (b.is_empty()) return {};
  if (identity_) return b;
  Box result;
  for (int row = 0; row < 3; ++row) {
    // Each output bound is the translation plus, per column, the smaller or larger of the two products (Arvo 1990).
    double low = matrix_[3][row];
    double high = low;
    double magnitude = std::abs(low);
    for (int column = 0; column < 3; ++column) {
      const double a = static_cast<double>(matrix_[column][row]) * b.lower[column];
      const double c = static_cast<double>(matrix_[column][row]) * b.upper[column];
      low += a < c ? a : c;
      high += a < c ? c : a;
      magnitude += std::max(std::abs(a), std::abs(c));
    }
    // Covers the rounding of rays into object space as well as of this sum.
    const double pad = magnitude * 4.0 * std::numeric_limits<float>::epsilon();
    result.lower[row] = std::nextafter(static_cast<float>(low - pad), -std::numeric_limits<float>::infinity());
    result.upper[row] = std::nextafter(static_cast<float>(high + pad), std::numeric_limits<float>::infinity());
  }
  return result;
}

}  // namespace grove
