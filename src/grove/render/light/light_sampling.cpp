#include "grove/render/light/light_sampling.h"

#include <algorithm>
#include <array>
#include <string>

#include "grove/base/error.h"

namespace grove {
namespace {

constexpr std::array<std::string_view, 4> kNames = {"hierarchy", "groups", "power", "uniform"};

}  // namespace

std::span<const std::string_view> light_sampling_names() {
  return kNames;
}

LightSampling light_sampling_from_name(std::string_view name) {
  const auto* const found = std::ranges::find(kNames, name);
  if (found == kNames.end()) {
    throw UsageError("unknown way to choose lights '" + std::string(name) + "'; choose one of hierarchy, groups, power, uniform");
  }
  return static_cast<LightSampling>(found - kNames.begin());
}

}  // namespace grove
