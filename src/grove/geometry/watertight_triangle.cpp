#include "grove/geometry/watertight_triangle.h"

#include <cmath>
#include <limits>

#include <glm/vec3.hpp>

namespace grove {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Half a unit in the last place of 1: the relative error of one float operation.
constexpr double kUnitRoundoff = 0x1p-24;

// One instruction each, unlike std::fmin and std::fmax; no argument is NaN here.
template <typename T>
T smaller(T a, T b) {
  return a < b ? a : b;
}
template <typename T>
T larger(T a, T b) {
  return a > b ? a : b;
}

// Keeps t within the stretch of the ray inside the triangle's bounds. The edge tests judge vertices that are off by the rounding of the
// shear, at most 2 u |x| + 4 u |z| sideways, so the bounds are widened by 6 u times the largest coordinate relative to the ray's
// origin; the traversals widen their boxes by more than that.
double clamp_to_bounds(const Ray& ray, const TriangleCorners& corners, double t) {
  double lower[3];
  double upper[3];
  double largest = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double o = ray.origin[axis];
    const float* c = corners.coordinates[axis];
    lower[axis] = smaller(c[0], smaller(c[1], c[2])) - o;
    upper[axis] = larger(c[0], larger(c[1], c[2])) - o;
    largest = larger(largest, larger(-lower[axis], upper[axis]));
  }
  const double pad = 6.0 * kUnitRoundoff * largest;
  double near = -kInfinity;
  double far = kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = ray.direction[axis];
    if (d == 0.0) continue;
    const double inverse = 1.0 / d;
    const double a = (lower[axis] - pad) * inverse;
    const double b = (upper[axis] + pad) * inverse;
    near = larger(near, smaller(a, b));
    far = smaller(far, larger(a, b));
  }
  return larger(near, smaller(far, t));
}

}  // namespace

WatertightRay::WatertightRay(const Ray& r) : ray(r) {
  const Vec3 d(std::fabs(r.direction.x), std::fabs(r.direction.y), std::fabs(r.direction.z));
  kz = d.x > d.y ? (d.x > d.z ? 0 : 2) : (d.y > d.z ? 1 : 2);
  kx = (kz + 1) % 3;
  ky = (kx + 1) % 3;
  if (r.direction[kz] < 0.0F) {
    const int swap = kx;
    kx = ky;
    ky = swap;
  }
  origin_x = splat(r.origin[kx]);
  origin_y = splat(r.origin[ky]);
  origin_z = splat(r.origin[kz]);
  shear_x = splat(r.direction[kx] / r.direction[kz]);
  shear_y = splat(r.direction[ky] / r.direction[kz]);
}

bool watertight::test_edges_in_double(Float4 x, Float4 y, Edges& edges) {
  const double ax = x[0], bx = x[1], cx = x[2];
  const double ay = y[0], by = y[1], cy = y[2];
  double u = cx * by - cy * bx;
  double v = ax * cy - ay * cx;
  double w = bx * ay - by * ax;
  if (!((u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0))) return false;
  const double sum = u + v + w;
  if (sum == 0.0) return false;  // the triangle is a line or a point as seen from the ray
  // Normalised, so that they are good floats at any scale.
  edges = {static_cast<float>(u / sum), static_cast<float>(v / sum), static_cast<float>(w / sum)};
  return true;
}

float watertight::hit_distance(const WatertightRay& ray, const TriangleCorners& corners, const Edges& edges) {
  using DVec3 = glm::dvec3;
  const DVec3 origin(ray.ray.origin);
  const DVec3 direction(ray.ray.direction);
  const DVec3 v0(corners.corner(0));
  const DVec3 v1(corners.corner(1));
  const DVec3 v2(corners.corner(2));
  const DVec3 p0 = v0 - origin;
  const DVec3 normal = glm::cross(v1 - v0, v2 - v0);
  const double facing = glm::dot(normal, direction);
  double t = glm::dot(normal, p0) / facing;
  if (!(std::fabs(t) < kInfinity)) {
    // Seen exactly edge-on: the plane says nothing. The vertices' depths, weighted by the edge functions, do.
    const int kz = ray.kz;
    const DVec3 p1 = v1 - origin;
    const DVec3 p2 = v2 - origin;
    const double sum = static_cast<double>(edges.u) + edges.v + edges.w;
    t = (edges.u * p0[kz] + edges.v * p1[kz] + edges.w * p2[kz]) / (sum * direction[kz]);
    if (!(std::fabs(t) < kInfinity)) return std::numeric_limits<float>::infinity();
  }
  return static_cast<float>(clamp_to_bounds(ray.ray, corners, t));
}

}  // namespace grove
