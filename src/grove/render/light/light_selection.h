#pragma once

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "grove/render/light/light_choice.h"
#include "grove/render/light/light_hierarchy.h"
#include "grove/render/light/light_receiver.h"
#include "grove/render/light/light_sampling.h"
#include "grove/render/sampling/alias_table.h"

namespace grove {

/// What choosing goes by.
struct LightDescription {
  /// Empty box: infinitely far, and the intensity is irradiance: of a surface that faces the light, or of any surface under an environment.
  LightBounds bounds;
  /// Of a directional light, unit length, towards the light; zeros for an environment.
  Vec3 direction{0.0F};
};

/// The hierarchy, with the lights that have no place in it beside it. Lights infinitely far are weighed one by one against the whole tree, by the
/// irradiance that they may cause: choosing takes time in proportion to their number. A share of the chance is spread evenly
/// over those of them, and the tree, that can contribute at all, so that none starves beside a brighter one that is hidden.
class HierarchicalChoice {
 public:
  HierarchicalChoice() = default;
  explicit HierarchicalChoice(std::span<const LightDescription> lights);

  [[nodiscard]] LightHierarchy::Choice choose(const LightReceiver& receiver, double u) const;
  [[nodiscard]] float probability(const LightReceiver& receiver, std::uint32_t light) const;

 private:
  struct Distant {
    std::uint32_t light = 0;
    float strength = 0.0F;
    Vec3 direction{0.0F};
  };
  // A share of the chance is `weight` * by_weight + even, of what has a weight at all.
  struct Shares {
    double by_weight = 0.0;
    double even = 0.0;
    [[nodiscard]] double of(float weight) const { return weight > 0.0F ? static_cast<double>(weight) * by_weight + even : 0.0; }
  };
  [[nodiscard]] static float weight(const Distant& light, const LightReceiver& receiver);
  [[nodiscard]] Shares shares(const LightReceiver& receiver, float tree_weight) const;

  LightHierarchy tree_;
  std::vector<Distant> distant_;
};

/// Chooses one of the lights of a scene for a receiver in one of the ways of LightSampling. Immutable; any number of threads may choose at once.
class LightSelection {
 public:
  using Choice = LightHierarchy::Choice;

  LightSelection() = default;
  /// `groups` cover `lights` in order, and are what `groups` goes by. `scene_radius` is how far the light from infinitely far counts for `power`.
  LightSelection(LightSampling sampling, std::span<const LightDescription> lights, std::vector<LightChoice::Group> groups,
                 float scene_radius);

  /// `u` in [0, 1)^2: the second coordinate refines the first. The probability is 0 where no light can contribute.
  [[nodiscard]] Choice choose(const LightReceiver& receiver, const Vec2& u) const;
  /// The chance of `choose` giving this light.
  [[nodiscard]] float probability(const LightReceiver& receiver, std::uint32_t light) const;

 private:
  // Power and uniform: chances that are the same everywhere.
  std::variant<std::monostate, HierarchicalChoice, LightChoice, AliasTable> way_;
};

}  // namespace grove
