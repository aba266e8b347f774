#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "grove/lab/ray_set.h"

namespace grove {

/// What the right answers to a set of rays are: brute force over every ray, or over an even sample of them where that would take long;
/// rays outside the sample are answered by the first structure that is compared, so that every ray of the others is checked.
class Reference {
 public:
  /// Traces as many of `rays`, evenly chosen, as cost `test_budget` tests when each tests all of the scene's `primitive_count`
  /// primitives; at least one. `brute` must test every primitive.
  Reference(const Accelerator& brute, std::uint64_t primitive_count, const RaySet& rays, std::uint64_t test_budget);

  /// The number of answers that differ, in any bit of any field, from the right ones; hits[k] answers ray k * `stride`. The first call
  /// with all rays settles those outside the sample; until then they count as right.
  [[nodiscard]] std::uint64_t count_mismatches(std::span<const Hit> hits, std::size_t stride = 1);

  /// How many rays brute force answered.
  [[nodiscard]] std::uint64_t sampled_count() const { return sampled_count_; }

 private:
  std::vector<Hit> hits_;  // complete once is_complete_
  std::uint64_t stride_ = 1;
  std::uint64_t sampled_count_ = 0;
  bool is_complete_ = false;
};

}  // namespace grove
