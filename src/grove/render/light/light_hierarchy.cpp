#include "grove/render/light/light_hierarchy.h"

#include <cmath>

#include "grove/render/light/build_light_hierarchy.h"

namespace grove {

LightHierarchy::LightHierarchy(std::span<const LightBounds> lights) {
  BuiltLightHierarchy built = build_light_hierarchy(lights, kMostDepth, kNoTrail);
  nodes_ = std::move(built.nodes);
  trails_ = std::move(built.trails);
}

LightHierarchy::Choice LightHierarchy::choose(const LightReceiver& receiver, double u) const {
  if (is_empty() || !(importance(receiver) > 0.0F)) return {};
  double chance = 1.0;
  const LightCluster* node = nodes_.data();
  while (!node->is_leaf()) {
    const LightCluster* const pair = nodes_.data() + node->number();
    const double second = chance_of_second(pair[0], pair[1], receiver);
    if (std::isnan(second)) return {};
    const double first = 1.0 - second;
    if (u < first) {
      u /= first;
      chance *= first;
      node = pair;
    } else {
      u = (u - first) / second;
      chance *= second;
      node = pair + 1;
    }
  }
  return {node->number(), static_cast<float>(chance)};
}

float LightHierarchy::probability(const LightReceiver& receiver, std::uint32_t light) const {
  if (light >= trails_.size() || trails_[light] == kNoTrail || !(importance(receiver) > 0.0F)) return 0.0F;
  std::uint64_t trail = trails_[light];
  double chance = 1.0;
  for (const LightCluster* node = nodes_.data(); !node->is_leaf(); trail >>= 1) {
    const LightCluster* const pair = nodes_.data() + node->number();
    const double second = chance_of_second(pair[0], pair[1], receiver);
    const bool goes_second = (trail & 1) != 0;
    chance *= goes_second ? second : 1.0 - second;
    if (!(chance > 0.0)) return 0.0F;
    node = pair + (goes_second ? 1 : 0);
  }
  return static_cast<float>(chance);
}

}  // namespace grove
