#pragma once

#include <cmath>
#include <cstdint>

#include "grove/accel/fast_bvh.h"
#include "grove/geometry/hit.h"
#include "grove/geometry/watertight_triangle.h"
#include "grove/math/box.h"
#include "grove/math/float4.h"

namespace grove {

/// What the rays of one batch share.
struct BatchBounds {
  Float4 lower;
  Float4 upper;

  explicit BatchBounds(const Box& bounds) : lower(to_float4(bounds.lower)), upper(to_float4(bounds.upper)) {}
};

/// A ray in flight.
///
/// A plane at p is met at t = p * inverse + offset, in one fused step. The offsets hold the origin moved by a pad, as in slab_ray.h, where 17 u of the
/// largest coordinate relative to the origin are accounted for (u = 2^-24). The fused step rounds once where that test rounds twice, but
/// the product in the offset has an error of u of the origin's own coordinate, and so has moving it: 4 u of that are added.
/// Directions are kept away from 0 by 2^-40 of the longest component. Such a ray leaves a padded slab that holds its origin later than any
/// other: after 2^40 * 24 u, more than 2^20, times the reach.
class BatchRay {
 public:
  float inverse[4];
  float offset[2][4];          ///< of near planes, of far planes
  float t_min;                 ///< at least 0
  std::uint32_t octant;        ///< bit i: component i of the direction is negative
  std::uint32_t planes[2][3];  ///< where near planes, and far planes, of each axis begin in a node, in floats

  /// The set-up of the triangle test, as in WatertightRay.
  std::uint32_t kx, ky, kz;
  float origin_k[3];  ///< along kx, ky, kz
  float shear_x, shear_y;
  /// Distances along the ray: 1 / direction[kz], and how far a hit may be off the distances of its triangle's corners.
  float inverse_z;
  float depth_pad;

  /// Sets up the ray, or returns false and leaves it undefined: for rays that hit nothing by definition, and those whose numbers are not where
  /// the rounding above is bounded. Those are coordinates beyond 2^60, a scene that reaches less than 2^-60 from the origin, and directions whose
  /// longest component is below 2^-20 or above 2^20.
  [[nodiscard, gnu::always_inline]] bool set(const Ray& ray, const BatchBounds& bounds) {
    ray_ = &ray;
    const Float4 origin = load4(&ray.origin.x);        // and t_min
    const Float4 direction = load4(&ray.direction.x);  // and t_max
    const Float4 length = magnitude(direction);
    const Float4 extent = magnitude(origin);
    const Float4 reach = max(magnitude(bounds.lower - origin), magnitude(bounds.upper - origin));
    const float longest = largest_of_three(length);
    const float farthest = largest_of_three(reach);
    const float most = largest_of_three(extent);
    // A NaN fails a comparison. The reach bounds the scene's own coordinates.
    const int is_regular = first_three_lanes(length <= splat(0x1p20F)) & first_three_lanes(extent <= splat(0x1p60F)) &
                           first_three_lanes(reach <= splat(0x1p60F));
    if (is_regular != 7 || !(longest >= 0x1p-20F && farthest >= 0x1p-60F && ray.t_min <= ray.t_max && ray.t_max >= 0.0F)) return false;

    const float pad = 0x1.8p-20F * farthest + 0x1p-22F * most;
    const Float4 least = with_sign_of(splat(0x1p-40F * longest), direction);
    const Float4 kept = length >= splat(0x1p-40F * longest) ? direction : least;
    const Float4 inverted = splat(1.0F) / kept;
    const Float4 shift = with_sign_of(splat(pad), direction);
    store4(inverted, inverse);
    store4(-((origin + shift) * inverted), offset[0]);
    store4(-((origin - shift) * inverted), offset[1]);
    octant = static_cast<std::uint32_t>(first_three_lanes(reinterpret_cast<Int4>(direction) < Int4{}));
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const std::uint32_t near_row = 2 * axis + (octant >> axis & 1U);
      planes[0][axis] = FastNode::kWidth * near_row;
      planes[1][axis] = FastNode::kWidth * (near_row ^ 1U);
    }
    t_min = ray.t_min > 0.0F ? ray.t_min : 0.0F;

    // The last of the longest, as WatertightRay chooses.
    constexpr std::uint8_t kHighestBit[8] = {0, 0, 1, 1, 2, 2, 2, 2};
    constexpr std::uint8_t kNext[3] = {1, 2, 0};
    kz = kHighestBit[first_three_lanes(length == splat(longest))];
    const std::uint32_t next = kNext[kz];
    const bool is_negative = (octant >> kz & 1U) != 0;
    kx = is_negative ? kNext[next] : next;
    ky = is_negative ? next : kNext[next];
    const float direction_z = ray.direction[static_cast<int>(kz)];
    float shear[4];
    store4(direction / splat(direction_z), shear);
    shear_x = shear[kx];
    shear_y = shear[ky];
    origin_k[0] = ray.origin[static_cast<int>(kx)];
    origin_k[1] = ray.origin[static_cast<int>(ky)];
    origin_k[2] = ray.origin[static_cast<int>(kz)];
    inverse_z = 1.0F / direction_z;
    depth_pad = pad * std::fabs(inverse_z);
    return true;
  }

  [[nodiscard]] const Ray& ray() const { return *ray_; }
  /// For the test of single triangles.
  [[nodiscard]] WatertightRay triangle_ray() const {
    return {*ray_, static_cast<int>(kx), static_cast<int>(ky), static_cast<int>(kz), shear_x, shear_y};
  }

 private:
  static Float4 magnitude(Float4 v) { return reinterpret_cast<Float4>(reinterpret_cast<Int4>(v) & 0x7fffffff); }
  static Float4 with_sign_of(Float4 magnitude, Float4 v) {
    return reinterpret_cast<Float4>(reinterpret_cast<Int4>(magnitude) | (reinterpret_cast<Int4>(v) & ~0x7fffffff));
  }
  static float largest_of_three(Float4 v) {
    const float a = v[0] > v[1] ? v[0] : v[1];
    return a > v[2] ? a : v[2];
  }

  const Ray* ray_;
};

}  // namespace grove
