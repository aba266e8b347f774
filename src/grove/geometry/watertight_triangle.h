#pragma once

// Ray-triangle test without gaps along shared edges and at shared vertices.
//
// Edge tests: Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection" (JCGT 2013). The vertices are sheared so that the ray becomes
// the z axis; three 2D edge functions then tell on which side of each edge the ray passes. Two things differ from the paper:
//
// - The sign of an edge function is exact. Rounding is monotonic, so a float difference of two float products has the sign of the
//   exact one unless it comes out as zero; then (and when the products overflow) it is taken again in double, where the products
//   are exact. Triangles that share an edge therefore always agree.
// - The paper's t, an interpolation of the vertices' depths with float weights, can be far off beside large walls. Here t comes from the
//   triangle's plane in double, and is kept where the ray passes the triangle, so that a traversal that skips boxes by distance can
//   never lose the hit, also where the boxes hold pieces of triangles (docs/decisions/0005-hits-that-cannot-be-lost.md).

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "grove/geometry/hit.h"
#include "grove/geometry/ray.h"
#include "grove/math/float4.h"

namespace grove {

/// A ray with the set-up that all its triangle tests share. The ray must be traceable.
struct WatertightRay {
  explicit WatertightRay(const Ray& r);
  /// With what the other constructor would work out.
  WatertightRay(const Ray& r, int x_axis, int y_axis, int z_axis, float x_shear, float y_shear)
      : ray(r),
        kx(x_axis),
        ky(y_axis),
        kz(z_axis),
        origin_x(splat(r.origin[x_axis])),
        origin_y(splat(r.origin[y_axis])),
        origin_z(splat(r.origin[z_axis])),
        shear_x(splat(x_shear)),
        shear_y(splat(y_shear)) {}

  Ray ray;
  int kx = 0, ky = 1, kz = 2;  ///< kz: the axis along which the ray moves most; kx, ky keep the winding
  /// In all lanes: the origin along kx, ky and kz, and how far kx and ky move with kz.
  Float4 origin_x, origin_y, origin_z, shear_x, shear_y;
};

/// The corners of a triangle by axis: x of the three corners, then y, then z. 36 bytes. In an array, one more float must be readable behind
/// the last: an axis is loaded as four.
struct TriangleCorners {
  float coordinates[3][3];

  TriangleCorners() = default;
  TriangleCorners(const Vec3& v0, const Vec3& v1, const Vec3& v2)
      : coordinates{{v0.x, v1.x, v2.x}, {v0.y, v1.y, v2.y}, {v0.z, v1.z, v2.z}} {}

  [[nodiscard]] Vec3 corner(int i) const { return {coordinates[0][i], coordinates[1][i], coordinates[2][i]}; }
  [[nodiscard]] Float4 axis(int i) const { return load4(reinterpret_cast<const float*>(this) + 3 * static_cast<std::ptrdiff_t>(i)); }
};

static_assert(sizeof(TriangleCorners) == 36);

namespace watertight {

/// How far the plane's distance may be from the point that the edge tests found, relative to the largest coordinate: as much again as the
/// rounding of the shear. The traversals widen their boxes by the sum of both and more.
inline constexpr double kDepthTolerance = 6.0 * 0x1p-24;

/// The edge functions, with signs turned so that a hit has them all >= 0 and their sum > 0. The weights of v0, v1, v2 in that order.
struct Edges {
  float u, v, w;
};

/// The corners as the ray sees them, in lanes 0 to 2: relative to its origin, sheared so that it is the z axis.
struct ShearedCorners {
  Float4 x, y, z;
};

/// Decides in double, for edge functions that came out as zero or overflowed. Returns whether the ray passes the triangle.
[[nodiscard]] bool test_edges_in_double(const ShearedCorners& sheared, Edges& edges);

/// The distance of a hit along the ray; see the head of this file. Always finite or infinite, never NaN.
[[nodiscard]] float hit_distance(const WatertightRay& ray, const TriangleCorners& corners, const ShearedCorners& sheared);

/// Whether the ray's line passes the triangle, edges and corners included. The three corners, then the three edges, share a register.
[[nodiscard]] inline bool test_edges(const WatertightRay& ray, const TriangleCorners& corners, ShearedCorners& sheared, Edges& edges) {
  const Float4 z = corners.axis(ray.kz) - ray.origin_z;
  const Float4 x = (corners.axis(ray.kx) - ray.origin_x) - ray.shear_x * z;
  const Float4 y = (corners.axis(ray.ky) - ray.origin_y) - ray.shear_y * z;
  sheared = {x, y, z};
  // Lane 0: edge from corner 1 to 2, the weight of corner 0; and so on around.
  const Float4 next_x = __builtin_shufflevector(x, x, 1, 2, 0, 3);
  const Float4 next_y = __builtin_shufflevector(y, y, 1, 2, 0, 3);
  const Float4 last_x = __builtin_shufflevector(x, x, 2, 0, 1, 3);
  const Float4 last_y = __builtin_shufflevector(y, y, 2, 0, 1, 3);
  const Float4 edge = last_x * next_y - last_y * next_x;
  const int negative = first_three_lanes(edge < splat(0.0F));
  const int positive = first_three_lanes(edge > splat(0.0F));
  if (negative != 0 && positive != 0) return false;
  const float magnitude = std::fabs(edge[0] + edge[1] + edge[2]);
  // Zero edges, overflow (NaN is neither negative nor positive) and sums so small that their quotients lose digits are left to doubles.
  if ((negative | positive) == 7 && magnitude >= 1e-30F && magnitude <= std::numeric_limits<float>::max()) {
    const Float4 weights = negative != 0 ? -edge : edge;
    edges = {weights[0], weights[1], weights[2]};
    return true;
  }
  return test_edges_in_double(sheared, edges);
}

}  // namespace watertight

/// Tests one triangle. When it is hit within [ray.t_min, hit.t], closer than `hit` or as close with a lower id, replaces `hit` (t, u, v
/// and primitive) and returns true. `primitive` points to the id, so that it is read only where it is needed.
inline bool intersect_watertight(const WatertightRay& ray, const TriangleCorners& corners, const std::uint32_t* primitive, Hit& hit) {
  watertight::ShearedCorners sheared;
  watertight::Edges edges;
  if (!watertight::test_edges(ray, corners, sheared, edges)) return false;
  const float t = watertight::hit_distance(ray, corners, sheared);
  if (!(t >= ray.ray.t_min && t >= 0.0F && is_closer(t, *primitive, hit))) return false;
  const float sum = edges.u + edges.v + edges.w;
  hit.t = t;
  hit.u = edges.v / sum;
  hit.v = edges.w / sum;
  hit.primitive = *primitive;
  return true;
}

/// Whether one triangle is hit with t in [ray.t_min, ray.t_max].
inline bool occluded_watertight(const WatertightRay& ray, const TriangleCorners& corners) {
  watertight::ShearedCorners sheared;
  watertight::Edges edges;
  if (!watertight::test_edges(ray, corners, sheared, edges)) return false;
  const float t = watertight::hit_distance(ray, corners, sheared);
  return t >= ray.ray.t_min && t >= 0.0F && t <= ray.ray.t_max && t < std::numeric_limits<float>::infinity();
}

/// A triangle's corners with the room that loading them takes, for testing one that is not in an array.
struct SingleTriangle {
  TriangleCorners corners;
  float padding = 0.0F;

  SingleTriangle(const Vec3& v0, const Vec3& v1, const Vec3& v2) : corners(v0, v1, v2) {}
};

}  // namespace grove
