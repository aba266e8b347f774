// Directional albedos of single-scattering GGX surfaces, integrated once with the sampling of visible normals, whose estimator is bounded
// by 1. They are what the compensation for multiple scattering divides by (Turquin 2019, "Practical Multiple Scattering Compensation
// for Microfacet Models").

#include "grove/render/bsdf/albedo_tables.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "grove/base/parallel.h"
#include "grove/render/bsdf/fresnel.h"
#include "grove/render/bsdf/ggx.h"

namespace grove {
namespace {

constexpr std::size_t kNodes = AlbedoTable::kNodes;
constexpr std::uint32_t kPoints = 1024;  // a regular lattice; twice as many change the tables by less than 1e-3

// A rank-1 lattice by the golden ratio: even in both coordinates.
Vec2 lattice_point(std::uint32_t i) {
  const double y = std::fmod(0.5 + 0.6180339887498949 * i, 1.0);
  return {(static_cast<float>(i) + 0.5F) / static_cast<float>(kPoints), static_cast<float>(y)};
}

Vec3 direction_at(float cosine) {
  return {std::sqrt(std::max(0.0F, 1.0F - cosine * cosine)), 0.0F, cosine};
}

struct Position {
  std::size_t node;
  float fraction;
};

Position locate(float value) {
  const float clamped = value > 0.0F ? std::min(value, 1.0F) : 0.0F;
  const float scaled = std::sqrt(clamped) * static_cast<float>(kNodes - 1);
  const std::size_t node = std::min(static_cast<std::size_t>(scaled), kNodes - 2);
  return {node, scaled - static_cast<float>(node)};
}

float interpolate(float a, float b, float fraction) {
  return a + (b - a) * fraction;
}

// The integral of 2 f(cosine) cosine over [0, 1], by the midpoint rule.
template <typename Function>
float cosine_weighted_mean(const Function& f) {
  constexpr int kSteps = 256;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const float cosine = (static_cast<float>(i) + 0.5F) / kSteps;
    sum += static_cast<double>(2.0F * cosine * f(cosine));
  }
  return static_cast<float>(sum / kSteps);
}

GgxAlbedo make_ggx_albedo() {
  // One thread: this runs under the lock of a static, where waiting for other tasks could come back to the same lock.
  GgxAlbedo result;
  for (std::size_t a = 0; a < kNodes; ++a) {
    const float alpha = AlbedoTable::node_alpha(a);
    for (std::size_t c = 0; c < kNodes; ++c) {
      const Vec3 wo = direction_at(AlbedoTable::node_cosine(c));
      double scale = 0.0;
      double bias = 0.0;
      for (std::uint32_t i = 0; i < kPoints; ++i) {
        const Vec3 m = a == 0 ? Vec3(0.0F, 0.0F, 1.0F) : sample_ggx_visible_normal(wo, alpha, lattice_point(i));
        const Vec3 wi = reflect_about(wo, m);
        if (wi.z <= 0.0F) continue;
        const float weight = a == 0 ? 1.0F : ggx_shadowing_over_masking(wo, wi, alpha);
        const float schlick = schlick_weight(glm::dot(wo, m));
        scale += static_cast<double>(weight * (1.0F - schlick));
        bias += static_cast<double>(weight * schlick);
      }
      result.scale.at(a, c) = static_cast<float>(scale / kPoints);
      result.bias.at(a, c) = static_cast<float>(bias / kPoints);
    }
  }
  for (std::size_t a = 0; a < kNodes; ++a) {
    const float alpha = AlbedoTable::node_alpha(a);
    // With compensation the albedo is (F0 A + F90 B) (1 + F0 k), k = (1 - A - B) / (A + B).
    const auto k = [&](float cosine) {
      const float single = result.scale(cosine, alpha) + result.bias(cosine, alpha);
      return (1.0F - single) / single;
    };
    result.mean_scale.at(a) = cosine_weighted_mean([&](float cosine) { return result.scale(cosine, alpha); });
    result.mean_bias.at(a) = cosine_weighted_mean([&](float cosine) { return result.bias(cosine, alpha); });
    result.mean_scale_gain.at(a) = cosine_weighted_mean([&](float cosine) { return result.scale(cosine, alpha) * k(cosine); });
    result.mean_bias_gain.at(a) = cosine_weighted_mean([&](float cosine) { return result.bias(cosine, alpha) * k(cosine); });
  }
  return result;
}

}  // namespace

float AlbedoTable::node_cosine(std::size_t i) {
  const float x = static_cast<float>(i) / static_cast<float>(kNodes - 1);
  return std::max(x * x, 1e-4F);
}

float AlbedoTable::node_alpha(std::size_t i) {
  const float x = static_cast<float>(i) / static_cast<float>(kNodes - 1);
  return x * x;
}

AlbedoTable::Place AlbedoTable::locate(float cosine, float alpha) {
  const Position c = grove::locate(cosine);
  const Position a = grove::locate(alpha);
  return {a.node * kNodes + c.node, c.fraction, a.fraction};
}

float AlbedoTable::at(const Place& place) const {
  const float* low = values_.data() + place.node;
  const float* high = low + kNodes;
  return interpolate(interpolate(low[0], low[1], place.cosine_fraction), interpolate(high[0], high[1], place.cosine_fraction),
                     place.alpha_fraction);
}

GgxAlbedo::Single GgxAlbedo::single(float cosine, float alpha) const {
  const AlbedoTable::Place place = AlbedoTable::locate(cosine, alpha);
  return {scale.at(place), bias.at(place)};
}

float GgxAlbedo::mean(float f0, float f90, float alpha) const {
  return f90 * mean_bias(alpha) + f0 * (mean_scale(alpha) + f90 * mean_bias_gain(alpha) + f0 * mean_scale_gain(alpha));
}

float AverageTable::operator()(float alpha) const {
  const Position a = locate(alpha);
  return interpolate(values_[a.node], values_[a.node + 1], a.fraction);
}

const GgxAlbedo& ggx_albedo() {
  static const GgxAlbedo albedo = make_ggx_albedo();
  return albedo;
}

DielectricAlbedo::DielectricAlbedo(float index) : ior(index) {
  parallel_for(kNodes * 2, 1, [&](std::size_t job) {
    const std::size_t side = job % 2;
    const std::size_t a = job / 2;
    const float eta = side == 0 ? ior : 1.0F / ior;
    const float alpha = AlbedoTable::node_alpha(a);
    for (std::size_t c = 0; c < kNodes; ++c) {
      const Vec3 wo = direction_at(AlbedoTable::node_cosine(c));
      double back = 0.0;
      double through = 0.0;
      for (std::uint32_t i = 0; i < kPoints; ++i) {
        const Vec3 m = a == 0 ? Vec3(0.0F, 0.0F, 1.0F) : sample_ggx_visible_normal(wo, alpha, lattice_point(i));
        const float fresnel = fresnel_dielectric(std::min(1.0F, glm::dot(wo, m)), eta);
        Vec3 wi = reflect_about(wo, m);
        if (wi.z > 0.0F) back += static_cast<double>(fresnel * (a == 0 ? 1.0F : ggx_shadowing_over_masking(wo, wi, alpha)));
        if (fresnel < 1.0F && refract_about(wo, m, eta, wi) && wi.z < 0.0F) {
          through += static_cast<double>((1.0F - fresnel) * (a == 0 ? 1.0F : ggx_shadowing_over_masking(wo, wi, alpha)));
        }
      }
      reflected[side].at(a, c) = static_cast<float>(back / kPoints);
      total[side].at(a, c) = static_cast<float>((back + through) / kPoints);
    }
  });
  for (std::size_t side = 0; side < 2; ++side) {
    for (std::size_t a = 0; a < kNodes; ++a) {
      const float alpha = AlbedoTable::node_alpha(a);
      mean_reflectance[side].at(a) =
          cosine_weighted_mean([&](float cosine) { return reflected[side](cosine, alpha) / std::max(1e-6F, total[side](cosine, alpha)); });
    }
  }
}

}  // namespace grove
