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

  /// The same for a structure whose hits may differ by rounding: those count that do not agree on whether there is one, or within 0.1 % on how far it is. Such a
  /// structure settles nothing.
  [[nodiscard]] std::uint64_t count_far_off(std::span<const Hit> hits, std::size_t stride = 1) const;

  /// How many rays brute force answered.
  [[nodiscard]] std::uint64_t sampled_count() const { return sampled_count_; }

 private:
  // Whether the right answer to ray i is known.
  [[nodiscard]] bool is_settled(std::size_t i) const { return is_complete_ || i % stride_ == 0; }

  std::vector<Hit> hits_;  // complete once is_complete_
  std::uint64_t stride_ = 1;
  std::uint64_t sampled_count_ = 0;
  bool is_complete_ = false;
};

}  // namespace grove
