#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "grove/render/light/light_bounds.h"
#include "grove/render/light/light_cluster.h"
#include "grove/render/light/light_receiver.h"

namespace grove {

/// Chooses one of many lights at finite distance in logarithmic time, after Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with
/// Adaptive Tree Splitting": a binary tree of clusters, walked down by chance in proportion to what the two children may send. One light a
/// leaf. The paper's adaptive splitting, which takes several lights where a cluster is near, is left out: one light is chosen.
///
/// Immutable; any number of threads may choose at once. 104 bytes a light.
class LightHierarchy {
 public:
  struct Choice {
    std::uint32_t light = 0;
    /// 0: no light can contribute.
    float probability = 0.0F;
  };

  /// No lights.
  LightHierarchy() = default;
  /// Over those of `lights` that are not empty, finite, and have an intensity above 0. Throws InputError for more than 2^29. The same tree for any number of threads.
  /// O(n log n), parallel in the caller's oneTBB arena.
  explicit LightHierarchy(std::span<const LightBounds> lights);

  [[nodiscard]] bool is_empty() const { return nodes_.empty(); }
  /// The root is node 0.
  [[nodiscard]] std::span<const LightCluster> nodes() const { return nodes_; }

  /// What all lights together may send to the receiver; 0 where there is none.
  [[nodiscard]] float importance(const LightReceiver& receiver) const { return is_empty() ? 0.0F : nodes_[0].importance(receiver); }

  /// `u` in [0, 1), of as many random bits as the chances are to be exact to: it is stretched and used again at each step.
  [[nodiscard]] Choice choose(const LightReceiver& receiver, double u) const;

  /// The chance of `choose` giving this light: the same steps down, by the light's trail of lefts and rights. 0 for lights that were left out.
  [[nodiscard]] float probability(const LightReceiver& receiver, std::uint32_t light) const;

  /// No leaf is deeper: a trail has a bit a level.
  static constexpr std::uint32_t kMostDepth = 63;

 private:
  static constexpr std::uint64_t kNoTrail = ~std::uint64_t{0};

  std::vector<LightCluster> nodes_;
  std::vector<std::uint64_t> trails_;  // of each light: from the root on, lowest bit first, 1 for the second child
};

}  // namespace grove
