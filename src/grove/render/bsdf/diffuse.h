#pragma once

#include <algorithm>

#include "grove/render/bsdf/bsdf_types.h"
#include "grove/render/sampling/warp.h"

namespace grove {

/// Lambert's: the same radiance in all directions of the viewer's side.
struct DiffuseBsdf {
  Vec3 reflectance{0.0F};

  [[nodiscard]] BsdfValue evaluate(const Vec3& /*wo*/, const Vec3& wi) const {
    if (wi.z <= 0.0F) return {};
    return {reflectance * (wi.z / kPi), wi.z / kPi};
  }

  [[nodiscard]] BsdfSample sample(const Vec3& /*wo*/, float /*u_lobe*/, const Vec2& u) const {
    const Vec3 wi = sample_cosine_hemisphere(u);
    return {.wi = wi, .weight = reflectance, .pdf = wi.z / kPi};
  }

  [[nodiscard]] Vec3 albedo(const Vec3& /*wo*/) const { return reflectance; }
  [[nodiscard]] bool is_delta() const { return false; }
};

/// Lambert's on both sides: one part reflected, one let through (leaves, paper, lamp shades).
struct DiffuseTransmissionBsdf {
  Vec3 reflectance{0.0F};
  Vec3 transmittance{0.0F};

  [[nodiscard]] BsdfValue evaluate(const Vec3& /*wo*/, const Vec3& wi) const {
    const float cosine = std::fabs(wi.z) / kPi;
    const float chance = reflection_chance();
    return wi.z > 0.0F ? BsdfValue{reflectance * cosine, cosine * chance} : BsdfValue{transmittance * cosine, cosine * (1.0F - chance)};
  }

  [[nodiscard]] BsdfSample sample(const Vec3& /*wo*/, float u_lobe, const Vec2& u) const {
    const float chance = reflection_chance();
    Vec3 wi = sample_cosine_hemisphere(u);
    const float cosine = wi.z / kPi;
    if (u_lobe < chance) return {.wi = wi, .weight = reflectance / chance, .pdf = cosine * chance};
    wi.z = -wi.z;
    return {.wi = wi, .weight = transmittance / (1.0F - chance), .pdf = cosine * (1.0F - chance)};
  }

  [[nodiscard]] Vec3 albedo(const Vec3& /*wo*/) const { return reflectance + transmittance; }
  [[nodiscard]] bool is_delta() const { return false; }

 private:
  [[nodiscard]] float reflection_chance() const {
    const float r = max_component(reflectance);
    const float t = max_component(transmittance);
    return r + t > 0.0F ? r / (r + t) : 1.0F;
  }
};

}  // namespace grove
