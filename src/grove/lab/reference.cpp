#include "grove/lab/reference.h"

#include <algorithm>
#include <cmath>

#include "grove/base/check.h"

namespace grove {

Reference::Reference(const Accelerator& brute, std::uint64_t primitive_count, const RaySet& rays, std::uint64_t test_budget)
    : hits_(rays.size()) {
  const std::uint64_t affordable = std::max<std::uint64_t>(1, test_budget / std::max<std::uint64_t>(1, primitive_count));
  stride_ = std::max<std::uint64_t>(1, (rays.size() + affordable - 1) / affordable);
  const RaySet sample = rays.every(stride_);
  std::vector<Hit> answers(sample.size());
  trace(brute, sample, answers);
  for (std::size_t i = 0; i < answers.size(); ++i) hits_[i * stride_] = answers[i];
  sampled_count_ = sample.size();
}

std::uint64_t Reference::count_mismatches(std::span<const Hit> hits, std::size_t stride) {
  GROVE_CHECK(hits.size() == (hits_.size() + stride - 1) / stride);
  std::uint64_t count = 0;
  for (std::size_t k = 0; k < hits.size(); ++k) {
    const std::size_t i = k * stride;
    if (!is_settled(i)) {
      if (stride == 1) hits_[i] = hits[k];
      continue;
    }
    if (!same_bits(hits_[i], hits[k])) ++count;
  }
  if (stride == 1) is_complete_ = true;
  return count;
}

std::uint64_t Reference::count_far_off(std::span<const Hit> hits, std::size_t stride) const {
  GROVE_CHECK(hits.size() == (hits_.size() + stride - 1) / stride);
  constexpr float kTolerance = 1e-3F;
  std::uint64_t count = 0;
  for (std::size_t k = 0; k < hits.size(); ++k) {
    if (!is_settled(k * stride)) continue;
    const Hit& right = hits_[k * stride];
    const bool is_near = !right || std::abs(hits[k].t - right.t) <= kTolerance * std::abs(right.t);
    if (static_cast<bool>(right) != static_cast<bool>(hits[k]) || !is_near) ++count;
  }
  return count;
}

}  // namespace grove
