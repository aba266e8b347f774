#include "grove/render/light/light_choice.h"

#include <algorithm>
#include <cmath>

namespace grove {
namespace {

// Of the chance, what is spread evenly: a hidden bright light then costs at most the other four fifths of the samples.
constexpr float kEvenShare = 0.2F;

LightChoice::Group joined(const LightChoice::Group& a, const LightChoice::Group& b) {
  LightChoice::Group result = a;
  result.count += b.count;
  result.box.grow(b.box);
  result.strength += b.strength;
  result.is_planar = false;
  return result;
}

float strength_at(const LightChoice::Group& group, const Vec3& from) {
  if (group.box.is_empty()) return group.strength;
  const Vec3 to_point = from - group.box.centre();
  if (group.is_planar && glm::dot(to_point, group.normal) <= 0.0F) return 0.0F;
  // Within its own size a group is no longer a point.
  const Vec3 extent = group.box.extent();
  const float distance_squared = std::max(glm::dot(to_point, to_point), 0.25F * glm::dot(extent, extent));
  const float result = group.strength / distance_squared;
  return std::isfinite(result) ? result : 0.0F;
}

}  // namespace

LightChoice::LightChoice(std::vector<Group> groups, std::span<const float> power) {
  // Some places are kept for light from infinitely far, which has no box to join.
  constexpr std::size_t kChunks = kMaxGroups - 4;
  const std::size_t count = groups.size();
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_chunk_start = count <= kMaxGroups || i == 0 || i * kChunks / count != (i - 1) * kChunks / count ||
                                groups[i].box.is_empty() != groups_.back().box.is_empty();
    if (is_chunk_start && groups_.size() < kMaxGroups) {
      groups_.push_back(groups[i]);
    } else {
      groups_.back() = joined(groups_.back(), groups[i]);
    }
  }
  for (const Group& group : groups_) within_.emplace_back(power.subspan(group.first, group.count));
}

LightChoice::Weights LightChoice::weigh(const Vec3& from) const {
  Weights weights;
  float sum = 0.0F;
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    weights.chance[i] = strength_at(groups_[i], from);
    sum += weights.chance[i];
  }
  const float even = 1.0F / static_cast<float>(groups_.size());
  const bool is_weighed = sum > 0.0F && std::isfinite(sum);
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    weights.chance[i] = is_weighed ? (1.0F - kEvenShare) * weights.chance[i] / sum + kEvenShare * even : even;
  }
  return weights;
}

LightChoice::Choice LightChoice::choose(const Vec3& from, float u) const {
  const Weights weights = weigh(from);
  std::size_t group = 0;
  while (group + 1 < groups_.size() && u >= weights.chance[group]) u -= weights.chance[group++];
  const float chance = weights.chance[group];
  const AliasTable::Draw draw = within_[group].draw(std::clamp(u / chance, 0.0F, 0x1.fffffep-1F));
  return {groups_[group].first + draw.index, chance * draw.probability};
}

float LightChoice::probability(const Vec3& from, std::uint32_t light) const {
  const auto after =
      std::upper_bound(groups_.begin(), groups_.end(), light, [](std::uint32_t value, const Group& group) { return value < group.first; });
  const auto group = static_cast<std::size_t>(after - groups_.begin() - 1);
  return weigh(from).chance[group] * within_[group].probability(light - groups_[group].first);
}

}  // namespace grove
