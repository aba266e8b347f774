#include "grove/render/sampling/alias_table.h"

#include <algorithm>
#include <cmath>

namespace grove {

AliasTable::AliasTable(std::span<const float> weights) {
  const std::size_t count = weights.size();
  if (count == 0) return;
  std::vector<double> share(count);
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    share[i] = weights[i] > 0.0F && std::isfinite(weights[i]) ? static_cast<double>(weights[i]) : 0.0;
    sum += share[i];
  }
  if (sum <= 0.0) {
    std::fill(share.begin(), share.end(), 1.0);
    sum = static_cast<double>(count);
  }
  probability_.resize(count);
  entries_.resize(count);
  std::vector<std::uint32_t> small;
  std::vector<std::uint32_t> large;
  for (std::size_t i = 0; i < count; ++i) {
    probability_[i] = static_cast<float>(share[i] / sum);
    share[i] *= static_cast<double>(count) / sum;
    (share[i] < 1.0 ? small : large).push_back(static_cast<std::uint32_t>(i));
  }
  // Each entry that has less than a fair share is filled up by one that has more.
  while (!small.empty() && !large.empty()) {
    const std::uint32_t low = small.back();
    const std::uint32_t high = large.back();
    small.pop_back();
    entries_[low] = {static_cast<float>(share[low]), high};
    share[high] -= 1.0 - share[low];
    if (share[high] < 1.0) {
      large.pop_back();
      small.push_back(high);
    }
  }
  // What is left differs from a fair share by rounding only.
  for (const std::uint32_t i : small) entries_[i] = {1.0F, i};
  for (const std::uint32_t i : large) entries_[i] = {1.0F, i};
}

AliasTable::Draw AliasTable::draw(float u) const {
  const float scaled = u * static_cast<float>(entries_.size());
  const auto slot = std::min(static_cast<std::size_t>(scaled), entries_.size() - 1);
  const float rest = std::min(std::max(scaled - static_cast<float>(slot), 0.0F), 0x1.fffffep-1F);
  const Entry& entry = entries_[slot];
  if (rest < entry.keep) {
    return {static_cast<std::uint32_t>(slot), probability_[slot], std::min(rest / entry.keep, 0x1.fffffep-1F)};
  }
  return {entry.alias, probability_[entry.alias], std::min((rest - entry.keep) / (1.0F - entry.keep), 0x1.fffffep-1F)};
}

}  // namespace grove
