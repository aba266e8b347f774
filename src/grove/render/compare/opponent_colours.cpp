#include "grove/render/compare/opponent_colours.h"

#include <cmath>

namespace grove {
namespace {

// Rec. 709 primaries with D65 white to CIE XYZ (IEC 61966-2-1), columns for red, green and blue.
const Mat3 kToXyz(0.4124564F, 0.2126729F, 0.0193339F, 0.3575761F, 0.7151522F, 0.1191920F, 0.1804375F, 0.0721750F, 0.9503041F);
const Mat3 kFromXyz = glm::inverse(kToXyz);
const Vec3 kWhite = kToXyz * Vec3(1.0F);

// CIELAB's cube root, straight below (6/29)^3.
float lab_root(float x) {
  constexpr float kDelta = 6.0F / 29.0F;
  return x > kDelta * kDelta * kDelta ? std::cbrt(x) : x / (3.0F * kDelta * kDelta) + 4.0F / 29.0F;
}

}  // namespace

Vec3 to_ycxcz(const Vec3& colour) {
  const Vec3 xyz = kToXyz * colour / kWhite;
  return {116.0F * xyz.y - 16.0F, 500.0F * (xyz.x - xyz.y), 200.0F * (xyz.y - xyz.z)};
}

Vec3 from_ycxcz(const Vec3& ycxcz) {
  const float y = (ycxcz.x + 16.0F) / 116.0F;
  return kFromXyz * (Vec3(y + ycxcz.y / 500.0F, y, y - ycxcz.z / 200.0F) * kWhite);
}

Vec3 to_hunt_lab(const Vec3& colour) {
  const Vec3 xyz = kToXyz * colour / kWhite;
  const float x = lab_root(xyz.x);
  const float y = lab_root(xyz.y);
  const float z = lab_root(xyz.z);
  const float lightness = 116.0F * y - 16.0F;
  return {lightness, 0.01F * lightness * 500.0F * (x - y), 0.01F * lightness * 200.0F * (y - z)};
}

float hyab(const Vec3& a, const Vec3& b) {
  const Vec3 difference = a - b;
  return std::fabs(difference.x) + std::sqrt(difference.y * difference.y + difference.z * difference.z);
}

}  // namespace grove
