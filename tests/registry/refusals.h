#pragma once

#include <algorithm>
#include <tuple>
#include <vector>

#include "grove/registry/registry.h"

namespace grove::test {

/// Whether a filter that refuses about half of what there is accepts a hit, by number: the far sides of spheres and all that lies behind come to light. Which
/// half is told by `salt`.
[[nodiscard]] inline bool is_in_half(const Hit& hit, std::uint32_t salt = 0) {
  std::uint32_t mixed =
      (hit.primitive * 0x9e3779b9U ^ (hit.geometry + 1U) * 0x85ebca6bU ^ (hit.instance + 1U) * 0xc2b2ae35U) + salt * 0x27d4eb2fU;
  // Which side of a sphere it is must count as well.
  mixed ^= hit.u > 0.5F ? 0x40000000U : 0U;
  return ((mixed ^ mixed >> 15) * 0x2c1b3c6dU >> 30 & 1U) != 0;
}

/// Refuses all hits and keeps account of them: what a traversal for any hit has asked about is all there is on the ray.
class RefuseAll {
 public:
  [[nodiscard]] HitFilter filter() { return {accept, this}; }
  [[nodiscard]] BatchHitFilter batch_filter() { return {accept_of_batch, this}; }

  /// What was asked about, each hit once, in an order that does not depend on that of asking.
  [[nodiscard]] std::vector<std::pair<std::size_t, Hit>> asked() const {
    const auto key = [](const std::pair<std::size_t, Hit>& entry) {
      const Hit& hit = entry.second;
      return std::tuple(entry.first, hit.instance, hit.geometry, hit.primitive, hit.t, hit.u, hit.v);
    };
    std::vector<std::pair<std::size_t, Hit>> sorted = asked_;
    std::sort(sorted.begin(), sorted.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    return sorted;
  }

  void note(std::size_t ray, const Hit& hit) { asked_.emplace_back(ray, hit); }

 private:
  static bool accept(void* context, const Hit& hit) { return accept_of_batch(context, 0, hit); }
  static bool accept_of_batch(void* context, std::size_t ray, const Hit& hit) {
    static_cast<RefuseAll*>(context)->note(ray, hit);
    return false;
  }

  std::vector<std::pair<std::size_t, Hit>> asked_;
};

}  // namespace grove::test
