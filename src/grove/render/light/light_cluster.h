#pragma once

#include <cstdint>

#include "grove/render/light/light_bounds.h"
#include "grove/render/light/light_receiver.h"

namespace grove {

/// A node of a light hierarchy: one light or several, as the choice of a way down sees them.
struct LightCluster {
  static constexpr std::uint32_t kLeaf = 0x80000000U;
  static constexpr std::uint32_t kTwoSided = 0x40000000U;
  static constexpr std::uint32_t kNumber = kTwoSided - 1;

  Vec3 centre{0.0F};
  float radius_squared = 0.0F;  // of the sphere around the box
  Vec3 axis{0.0F};
  float cos_theta_o = 1.0F;
  float sin_theta_o = 0.0F;
  float cos_theta_e = 0.0F;
  float intensity = 0.0F;
  /// A leaf's light, or else the first of two neighbouring children, with the flags.
  std::uint32_t link = 0;

  LightCluster() = default;
  LightCluster(const LightBounds& bounds, std::uint32_t number, bool is_leaf);

  [[nodiscard]] bool is_leaf() const { return (link & kLeaf) != 0; }
  [[nodiscard]] std::uint32_t number() const { return link & kNumber; }

  /// How much light the cluster may send to the receiver if nothing stands between (the paper's equation 3): the intensity over the distance squared,
  /// times the cosines at emitter and receiver where they are largest over the sphere around the cluster. Within the sphere the distance is its
  /// radius. 0 only where none of the lights can contribute; finite. The bounds are widened by more than rounding can be off.
  [[nodiscard]] float importance(const LightReceiver& receiver) const;
};
static_assert(sizeof(LightCluster) == 48);

/// The chance of the second of two clusters, in proportion to their importances; NaN where neither can contribute.
[[nodiscard]] double chance_of_second(const LightCluster& first, const LightCluster& second, const LightReceiver& receiver);

}  // namespace grove
