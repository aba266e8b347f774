#pragma once

#include "grove/math/box.h"

namespace grove {

/// Bounds of the part of a triangle inside a box, rounded outward but never outside the box; empty when they do not meet.
/// Sutherland and Hodgman 1974, in double: the polygon has at most nine corners.
[[nodiscard]] Box clip_triangle(const Vec3& v0, const Vec3& v1, const Vec3& v2, const Box& box);

}  // namespace grove
