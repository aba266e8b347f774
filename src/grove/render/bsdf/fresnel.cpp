#include "grove/render/bsdf/fresnel.h"

#include <algorithm>
#include <cmath>

namespace grove {

float fresnel_dielectric(float cosine, float eta) {
  const float sine_squared_t = (1.0F - cosine * cosine) / (eta * eta);
  if (sine_squared_t >= 1.0F) return 1.0F;
  const float cosine_t = std::sqrt(1.0F - sine_squared_t);
  const float parallel = (eta * cosine - cosine_t) / (eta * cosine + cosine_t);
  const float perpendicular = (cosine - eta * cosine_t) / (cosine + eta * cosine_t);
  return std::min(1.0F, 0.5F * (parallel * parallel + perpendicular * perpendicular));
}

Vec3 fresnel_conductor(float cosine, const Vec3& eta, const Vec3& k) {
  // Born and Wolf, "Principles of Optics", section 14.2, in real arithmetic: with c the cosine and s^2 = 1 - c^2,
  // a^2 + b^2 = |sqrt((eta + ik)^2 - s^2)|^2 and 2 a^2 = a^2 + b^2 + (eta^2 - k^2 - s^2).
  const float c2 = cosine * cosine;
  const float s2 = 1.0F - c2;
  Vec3 result;
  for (int channel = 0; channel < 3; ++channel) {
    const float n2 = eta[channel] * eta[channel];
    const float k2 = k[channel] * k[channel];
    const float difference = n2 - k2 - s2;
    const float sum = std::sqrt(difference * difference + 4.0F * n2 * k2);
    const float a = std::sqrt(std::max(0.0F, 0.5F * (sum + difference)));
    const float first = sum + c2;
    const float second = 2.0F * a * cosine;
    const float perpendicular = (first - second) / (first + second);
    const float third = c2 * sum + s2 * s2;
    const float fourth = second * s2;
    const float parallel = perpendicular * (third - fourth) / (third + fourth);
    result[channel] = std::clamp(0.5F * (parallel + perpendicular), 0.0F, 1.0F);
  }
  return result;
}

bool refract_about(const Vec3& wo, const Vec3& m, float eta, Vec3& wi) {
  const float cosine = glm::dot(wo, m);
  const float sine_squared_t = std::max(0.0F, 1.0F - cosine * cosine) / (eta * eta);
  if (sine_squared_t >= 1.0F) return false;
  const float cosine_t = std::sqrt(1.0F - sine_squared_t);
  wi = glm::normalize(-wo / eta + (cosine / eta - cosine_t) * m);
  return true;
}

}  // namespace grove
