#include "grove/render/light/light_selection.h"

#include <algorithm>
#include <cmath>

namespace grove {
namespace {

// As in light_choice.cpp: a hidden bright light costs at most the other four fifths of the samples.
constexpr double kEvenShare = 0.2;
// As for clusters: a shading normal may see light that just sets for the geometric one.
constexpr float kLeastCosine = 0.05F;
constexpr float kSlack = 1e-3F;

float power_of(const LightDescription& light, float scene_radius) {
  if (light.bounds.is_empty()) return light.bounds.intensity * kPi * scene_radius * scene_radius;
  return light.bounds.intensity * light.bounds.orientation_measure();
}

AliasTable table_of(std::span<const LightDescription> lights, bool by_power, float scene_radius) {
  std::vector<float> weights;
  weights.reserve(lights.size());
  for (const LightDescription& light : lights) {
    const bool can_shine = light.bounds.intensity > 0.0F && std::isfinite(light.bounds.intensity);
    const float weight = by_power ? power_of(light, scene_radius) : 1.0F;
    weights.push_back(can_shine ? weight : 0.0F);
  }
  return AliasTable(weights);
}

std::vector<float> strengths_of(std::span<const LightDescription> lights) {
  std::vector<float> strengths;
  strengths.reserve(lights.size());
  for (const LightDescription& light : lights) strengths.push_back(light.bounds.intensity);
  return strengths;
}

}  // namespace

HierarchicalChoice::HierarchicalChoice(std::span<const LightDescription> lights) {
  std::vector<LightBounds> bounds;
  bounds.reserve(lights.size());
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    const LightDescription& light = lights[i];
    bounds.push_back(light.bounds);
    const float strength = light.bounds.intensity;
    if (light.bounds.is_empty() && strength > 0.0F && std::isfinite(strength)) {
      distant_.push_back({.light = i, .strength = strength, .direction = light.direction});
    }
  }
  tree_ = LightHierarchy(bounds);
}

float HierarchicalChoice::weight(const Distant& light, const LightReceiver& receiver) {
  if (receiver.side == LightReceiver::Side::any || light.direction == Vec3(0.0F)) return light.strength;
  float cosine = glm::dot(light.direction, receiver.normal);
  if (receiver.side == LightReceiver::Side::both) cosine = std::fabs(cosine);
  return cosine < -kSlack ? 0.0F : light.strength * std::max(cosine, kLeastCosine);
}

HierarchicalChoice::Shares HierarchicalChoice::shares(const LightReceiver& receiver, float tree_weight) const {
  double sum = static_cast<double>(tree_weight);
  int count = tree_weight > 0.0F ? 1 : 0;
  for (const Distant& light : distant_) {
    const float w = weight(light, receiver);
    sum += static_cast<double>(w);
    count += w > 0.0F ? 1 : 0;
  }
  if (count == 0) return {};
  if (count == 1) return {1.0 / sum, 0.0};
  return {(1.0 - kEvenShare) / sum, kEvenShare / count};
}

LightHierarchy::Choice HierarchicalChoice::choose(const LightReceiver& receiver, double u) const {
  const float tree_weight = tree_.importance(receiver);
  const Shares shares = this->shares(receiver, tree_weight);
  for (const Distant& light : distant_) {
    const double share = shares.of(weight(light, receiver));
    if (u < share) return {light.light, static_cast<float>(share)};
    u -= share;
  }
  // The tree takes the rest.
  const double share = shares.of(tree_weight);
  if (!(share > 0.0)) return {};
  LightHierarchy::Choice choice = tree_.choose(receiver, std::min(u / share, 0x1.fffffffffffffp-1));
  choice.probability *= static_cast<float>(share);
  return choice;
}

float HierarchicalChoice::probability(const LightReceiver& receiver, std::uint32_t light) const {
  const float tree_weight = tree_.importance(receiver);
  const Shares shares = this->shares(receiver, tree_weight);
  for (const Distant& distant : distant_)
    if (distant.light == light) return static_cast<float>(shares.of(weight(distant, receiver)));
  const double share = shares.of(tree_weight);
  return share > 0.0 ? tree_.probability(receiver, light) * static_cast<float>(share) : 0.0F;
}

LightSelection::LightSelection(LightSampling sampling, std::span<const LightDescription> lights, std::vector<LightChoice::Group> groups,
                               float scene_radius) {
  if (lights.empty()) return;
  switch (sampling) {
    case LightSampling::hierarchy:
      way_ = HierarchicalChoice(lights);
      break;
    case LightSampling::groups:
      way_ = LightChoice(std::move(groups), strengths_of(lights));
      break;
    case LightSampling::power:
      way_ = table_of(lights, true, scene_radius);
      break;
    case LightSampling::uniform:
      way_ = table_of(lights, false, scene_radius);
      break;
  }
}

LightSelection::Choice LightSelection::choose(const LightReceiver& receiver, const Vec2& u) const {
  if (const auto* hierarchy = std::get_if<HierarchicalChoice>(&way_)) {
    // Both are multiples of 2^-24.
    return hierarchy->choose(receiver, static_cast<double>(u.x) + 0x1p-24 * static_cast<double>(u.y));
  }
  if (const auto* groups = std::get_if<LightChoice>(&way_)) {
    const LightChoice::Choice choice = groups->choose(receiver.position, u.x);
    return {choice.light, choice.probability};
  }
  if (const auto* table = std::get_if<AliasTable>(&way_)) {
    const AliasTable::Draw draw = table->draw(u.x);
    return {draw.index, draw.probability};
  }
  return {};
}

float LightSelection::probability(const LightReceiver& receiver, std::uint32_t light) const {
  if (const auto* hierarchy = std::get_if<HierarchicalChoice>(&way_)) return hierarchy->probability(receiver, light);
  if (const auto* groups = std::get_if<LightChoice>(&way_)) return groups->probability(receiver.position, light);
  if (const auto* table = std::get_if<AliasTable>(&way_)) return table->probability(light);
  return 0.0F;
}

}  // namespace grove
