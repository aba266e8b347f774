#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "grove/math/box.h"
#include "grove/render/sampling/alias_table.h"

namespace grove {

/// Chooses one of many lights as seen from a point. Lights come in groups (an emissive part of an instance; one punctual light; the
/// environment). A group is chosen in proportion to the light that it would send to the point if nothing stood between, a light within
/// the group by its power. A share is spread evenly over the groups, so that none starves beside a brighter one that is hidden.
class LightChoice {
 public:
  /// Lights with neighbouring numbers.
  struct Group {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    /// What holds the lights, empty for light from infinitely far.
    Box box;
    /// Irradiance at unit distance from the middle, or at any place for light from infinitely far.
    float strength = 0.0F;
    /// All light leaves on one side of a plane through the middle of the box.
    bool is_planar = false;
    Vec3 normal{0.0F};
  };

  struct Choice {
    std::uint32_t light = 0;
    float probability = 0.0F;
  };

  LightChoice() = default;
  /// `groups` cover lights 0 to power.size() - 1 in order. Where there are more groups than can be weighed at every point, neighbours are
  /// joined.
  LightChoice(std::vector<Group> groups, std::span<const float> power);

  [[nodiscard]] bool is_empty() const { return groups_.empty(); }
  /// `u` in [0, 1).
  [[nodiscard]] Choice choose(const Vec3& from, float u) const;
  /// The chance of `choose` giving this light.
  [[nodiscard]] float probability(const Vec3& from, std::uint32_t light) const;

 private:
  static constexpr std::size_t kMaxGroups = 32;
  struct Weights {
    float chance[kMaxGroups];
  };
  [[nodiscard]] Weights weigh(const Vec3& from) const;

  std::vector<Group> groups_;
  std::vector<AliasTable> within_;
};

}  // namespace grove
