#include "grove/render/light/light_cluster.h"

#include <algorithm>
#include <cmath>

namespace grove {
namespace {

// By what bounding spheres are widened, relative to their size, and cones, in terms of the cosine.
constexpr float kWiden = 1.001F;
constexpr float kSlack = 1e-3F;
// What light counts at least that may come in flatly: the shading normal may see it higher above its horizon than the geometric one.
constexpr float kLeastCosine = 0.05F;
// Two importances can be added.
constexpr float kMostImportance = 1e37F;

struct Angle {
  float cosine;
  float sine;
};

Angle angle_of(float cosine) {
  return {cosine, std::sqrt(std::max(0.0F, 1.0F - cosine * cosine))};
}

// max(0, a - b), for angles from 0 to pi.
Angle less(const Angle& a, const Angle& b) {
  if (a.cosine >= b.cosine) return {1.0F, 0.0F};
  return {a.cosine * b.cosine + a.sine * b.sine, a.sine * b.cosine - a.cosine * b.sine};
}

// The largest cosine at the receiver of light from within `half_width` of a direction, or 0 where the receiver has no use for any of it.
float receiver_cosine(LightReceiver::Side side, float cosine, const Angle& half_width) {
  if (side == LightReceiver::Side::both) cosine = std::fabs(cosine);
  const float largest = less(angle_of(cosine), half_width).cosine;
  return largest < -kSlack ? 0.0F : std::max(largest, kLeastCosine);
}

}  // namespace

LightCluster::LightCluster(const LightBounds& bounds, std::uint32_t number, bool is_leaf)
    : centre(bounds.box.centre()),
      axis(bounds.axis),
      cos_theta_o(std::cos(bounds.theta_o)),
      sin_theta_o(std::sin(bounds.theta_o)),
      cos_theta_e(std::cos(bounds.theta_e)),
      intensity(bounds.intensity),
      link(number | (is_leaf ? kLeaf : 0U) | (bounds.is_two_sided ? kTwoSided : 0U)) {
  const Vec3 extent = bounds.box.extent();
  radius_squared = 0.25F * kWiden * kWiden * glm::dot(extent, extent);
}

float LightCluster::importance(const LightReceiver& receiver) const {
  const Vec3 offset = receiver.position - centre;
  const float distance_squared = glm::dot(offset, offset);
  const float divisor = std::max(distance_squared, radius_squared);
  // A point light sends no light to where it is.
  if (!(divisor > 0.0F)) return 0.0F;
  const float result = std::min(intensity / divisor, kMostImportance);
  if (distance_squared <= radius_squared) return result;

  const float inverse_distance = 1.0F / std::sqrt(distance_squared);
  const float sine_squared = radius_squared / distance_squared;
  const Angle half_width{std::sqrt(1.0F - sine_squared), std::sqrt(sine_squared)};
  float cosine = glm::dot(axis, offset) * inverse_distance;
  if ((link & kTwoSided) != 0) cosine = std::fabs(cosine);
  const float emitted = less(less(angle_of(cosine), {cos_theta_o, sin_theta_o}), half_width).cosine;
  if (emitted < cos_theta_e - kSlack) return 0.0F;
  // At its edge a cone of light may end with no cosine at all.
  const float sent = result * std::max(emitted, kSlack);
  if (receiver.side == LightReceiver::Side::any) return sent;
  return sent * receiver_cosine(receiver.side, -glm::dot(receiver.normal, offset) * inverse_distance, half_width);
}

double chance_of_second(const LightCluster& first, const LightCluster& second, const LightReceiver& receiver) {
  const auto importance = static_cast<double>(second.importance(receiver));
  return importance / (static_cast<double>(first.importance(receiver)) + importance);
}

}  // namespace grove
