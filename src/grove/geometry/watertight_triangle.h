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
//   triangle's plane in double, and is kept within the stretch of the ray that lies in the triangle's bounds, so that a traversal that
//   skips boxes by distance can never lose the hit (docs/decisions/0005-hits-that-cannot-be-lost.md).

#include <cmath>
#include <cstdint>
#include <limits>

#include "grove/geometry/hit.h"
#include "grove/geometry/ray.h"

namespace grove {

/// A ray with the set-up that all its triangle tests share. The ray must be traceable.
struct WatertightRay {
  explicit WatertightRay(const Ray& r);

  Ray ray;
  int kx = 0, ky = 1, kz = 2;  ///< kz: the axis along which the ray moves most; kx, ky keep the winding
  float shear_x = 0.0F, shear_y = 0.0F;
};

namespace watertight {

/// The edge functions, with signs turned so that a hit has them all >= 0 and their sum > 0. The weights of v0, v1, v2 in that order.
struct Edges {
  float u, v, w;
};

/// Decides in double, for edge functions that came out as zero or overflowed. Returns whether the ray passes the triangle.
[[nodiscard]] bool test_edges_in_double(const float x[3], const float y[3], Edges& edges);

/// The distance of a hit along the ray; see the head of this file. Always finite or infinite, never NaN.
[[nodiscard]] float hit_distance(const WatertightRay& ray, const Vec3& v0, const Vec3& v1, const Vec3& v2, const Edges& edges);

/// Whether the ray's line passes the triangle, edges and corners included.
[[nodiscard]] inline bool test_edges(const WatertightRay& ray, const Vec3& v0, const Vec3& v1, const Vec3& v2, Edges& edges) {
  const Vec3& o = ray.ray.origin;
  const int kx = ray.kx;
  const int ky = ray.ky;
  const int kz = ray.kz;
  const float az = v0[kz] - o[kz];
  const float bz = v1[kz] - o[kz];
  const float cz = v2[kz] - o[kz];
  const float ax = (v0[kx] - o[kx]) - ray.shear_x * az;
  const float ay = (v0[ky] - o[ky]) - ray.shear_y * az;
  const float bx = (v1[kx] - o[kx]) - ray.shear_x * bz;
  const float by = (v1[ky] - o[ky]) - ray.shear_y * bz;
  const float cx = (v2[kx] - o[kx]) - ray.shear_x * cz;
  const float cy = (v2[ky] - o[ky]) - ray.shear_y * cz;
  const float u = cx * by - cy * bx;
  const float v = ax * cy - ay * cx;
  const float w = bx * ay - by * ax;
  const bool any_negative = u < 0.0F || v < 0.0F || w < 0.0F;
  const bool any_positive = u > 0.0F || v > 0.0F || w > 0.0F;
  if (any_negative && any_positive) return false;
  const float magnitude = std::fabs(u + v + w);
  // Zero edges, overflow (NaN fails every comparison) and sums so small that their quotients lose digits are left to doubles.
  if (u != 0.0F && v != 0.0F && w != 0.0F && magnitude >= 1e-30F && magnitude <= std::numeric_limits<float>::max()) {
    edges = any_negative ? Edges{-u, -v, -w} : Edges{u, v, w};
    return true;
  }
  const float x[3] = {ax, bx, cx};
  const float y[3] = {ay, by, cy};
  return test_edges_in_double(x, y, edges);
}

}  // namespace watertight

/// Tests one triangle. When it is hit within [ray.t_min, hit.t], closer than `hit` or as close with a lower id, replaces `hit` (t, u, v
/// and primitive) and returns true. `primitive` points to the id, so that it is read only where it is needed.
inline bool intersect_watertight(const WatertightRay& ray, const Vec3& v0, const Vec3& v1, const Vec3& v2, const std::uint32_t* primitive,
                                 Hit& hit) {
  watertight::Edges edges;
  if (!watertight::test_edges(ray, v0, v1, v2, edges)) return false;
  const float t = watertight::hit_distance(ray, v0, v1, v2, edges);
  if (!(t >= ray.ray.t_min && t >= 0.0F && is_closer(t, *primitive, hit))) return false;
  const float sum = edges.u + edges.v + edges.w;
  hit.t = t;
  hit.u = edges.v / sum;
  hit.v = edges.w / sum;
  hit.primitive = *primitive;
  return true;
}

/// Whether one triangle is hit with t in [ray.t_min, ray.t_max].
inline bool occluded_watertight(const WatertightRay& ray, const Vec3& v0, const Vec3& v1, const Vec3& v2) {
  watertight::Edges edges;
  if (!watertight::test_edges(ray, v0, v1, v2, edges)) return false;
  const float t = watertight::hit_distance(ray, v0, v1, v2, edges);
  return t >= ray.ray.t_min && t >= 0.0F && t <= ray.ray.t_max && t < std::numeric_limits<float>::infinity();
}

}  // namespace grove
