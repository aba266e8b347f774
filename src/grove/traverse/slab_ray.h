#pragma once

// Conservative ray-box tests: a box is never skipped that holds a hit of one of the primitive tests.
//
// The slab test (Kay and Kajiya 1986) of a box that is widened on all sides by `pad`, which covers both the rounding of this test and the
// distance by which a hit of the watertight triangle test may be off its triangle: at most 7 u of the largest coordinate relative to the
// origin for the point that the edge tests find and 6 u for the distance along the ray (u = 2^-24); with 3 u for the slabs and 1 u for
// rounding t that is 17 u, taken here as 24 u. A hit is that near to the triangle itself and not only to its bounds, so the same
// holds for boxes around pieces of triangles. The boxes stay as they
// are: the origin is moved instead, once for near planes and once for far planes, so the widening costs nothing per box (Woop et
// al. 2013, section 4, with the bounds of the whole structure in place of those of each node).

#include <cmath>
#include <limits>

#include "grove/geometry/ray.h"
#include "grove/math/box.h"

namespace grove {

/// A ray set up for slab tests against boxes inside `bounds`. Per axis: t of a near plane is (plane - origin_near) * inverse_near, of a far
/// plane (plane - origin_far) * inverse_far. NaN (0 times infinity, for a ray inside a plane) means: no limit from this plane.
struct SlabRay {
  float origin_near[3];
  float origin_far[3];
  float inverse_near[3];
  float inverse_far[3];
  bool negative[3];  ///< the direction's component has its sign bit set: the upper plane is the near one

  SlabRay(const Ray& ray, const Box& bounds) {
    float largest = 0.0F;
    for (int axis = 0; axis < 3; ++axis) {
      const float below = std::fabs(bounds.lower[axis] - ray.origin[axis]);
      const float above = std::fabs(bounds.upper[axis] - ray.origin[axis]);
      largest = largest > below ? largest : below;
      largest = largest > above ? largest : above;
    }
    const float pad = 0x1.8p-20F * largest;
    for (int axis = 0; axis < 3; ++axis) {
      const float o = ray.origin[axis];
      const float d = ray.direction[axis];
      negative[axis] = std::signbit(d);  // also of -0, whose inverse is minus infinity
      const float low = next_below(o - pad);
      const float high = next_above(o + pad);
      origin_near[axis] = negative[axis] ? low : high;
      origin_far[axis] = negative[axis] ? high : low;
      const float inverse = 1.0F / d;
      // A denormal component has no finite inverse. The largest float makes near distances too small and infinity makes far
      // ones too large: both on the safe side.
      inverse_far[axis] = inverse;
      inverse_near[axis] = d != 0.0F && std::isinf(inverse) ? std::copysign(std::numeric_limits<float>::max(), inverse) : inverse;
    }
  }

  /// One or two steps of the last place down or up, for finite values: std::nextafter without its library call.
  [[nodiscard]] static float next_below(float v) { return v - step(v); }
  [[nodiscard]] static float next_above(float v) { return v + step(v); }

 private:
  static float step(float v) {
    const float s = std::fabs(v) * 0x1p-23F;
    return s > 0.0F ? s : std::numeric_limits<float>::denorm_min();
  }
};

}  // namespace grove
