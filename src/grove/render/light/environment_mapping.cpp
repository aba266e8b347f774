#include "grove/render/light/environment_mapping.h"

#include <algorithm>
#include <cmath>

namespace grove {
namespace {

// The upper hemisphere is the inner diamond of the square, each quadrant of it a triangle in which the distance from the middle is the
// distance from the pole in area; the lower hemisphere is the four corners, turned outward.
Vec2 octahedral_uv(const Vec3& w) {
  const float x = std::fabs(w.x);
  const float y = std::fabs(w.y);
  const float r = std::sqrt(std::max(0.0F, 1.0F - std::fabs(w.z)));
  const float phi = x == 0.0F && y == 0.0F ? 0.0F : std::atan2(y, x) * (2.0F / kPi);  // 0 to 1 over the quadrant
  float v = phi * r;
  float u = r - v;
  if (w.z < 0.0F) {
    const float outward = 1.0F - v;
    v = 1.0F - u;
    u = outward;
  }
  return {0.5F * (std::copysign(u, w.x) + 1.0F), 0.5F * (std::copysign(v, w.y) + 1.0F)};
}

Vec3 octahedral_direction(const Vec2& uv) {
  const float u = 2.0F * uv.x - 1.0F;
  const float v = 2.0F * uv.y - 1.0F;
  const float au = std::fabs(u);
  const float av = std::fabs(v);
  const float inside = 1.0F - (au + av);  // negative in the corners
  const float r = 1.0F - std::fabs(inside);
  const float phi = (r == 0.0F ? 1.0F : (av - au) / r + 1.0F) * (0.25F * kPi);
  const float z = std::copysign(1.0F - r * r, inside);
  const float radius = r * std::sqrt(std::max(0.0F, 2.0F - r * r));
  return {std::copysign(std::cos(phi), u) * radius, std::copysign(std::sin(phi), v) * radius, z};
}

}  // namespace

Vec2 environment_uv(EnvironmentMapping mapping, const Vec3& direction) {
  if (mapping == EnvironmentMapping::octahedral) return octahedral_uv(direction);
  const float azimuth = direction.x == 0.0F && direction.z == 0.0F ? 0.0F : std::atan2(direction.x, -direction.z);
  return {0.5F + azimuth / (2.0F * kPi), std::acos(std::clamp(direction.y, -1.0F, 1.0F)) / kPi};
}

Vec3 environment_direction(EnvironmentMapping mapping, const Vec2& uv) {
  if (mapping == EnvironmentMapping::octahedral) return octahedral_direction(uv);
  const float azimuth = (uv.x - 0.5F) * 2.0F * kPi;
  const float polar = uv.y * kPi;
  const float sine = std::sin(polar);
  return {sine * std::sin(azimuth), std::cos(polar), -sine * std::cos(azimuth)};
}

float environment_area_per_solid_angle(EnvironmentMapping mapping, const Vec3& direction) {
  if (mapping == EnvironmentMapping::octahedral) return 1.0F / (4.0F * kPi);
  const float sine = std::sqrt(direction.x * direction.x + direction.z * direction.z);
  return 1.0F / (2.0F * kPi * kPi * sine);
}

}  // namespace grove
