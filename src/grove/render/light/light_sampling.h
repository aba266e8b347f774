#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace grove {

/// How one of the lights of a scene is chosen for a point. All give the same picture in the end; they differ in noise and time.
enum class LightSampling : std::uint8_t {
  hierarchy,  ///< by distance, orientation and intensity, down a tree of clusters (light_hierarchy.h)
  groups,     ///< groups of lights by what they may send to the point, lights within a group by strength (light_choice.h)
  power,      ///< by power alone, the same for all points
  uniform     ///< each light as likely as any other
};

/// The names, in the order of the enumeration.
[[nodiscard]] std::span<const std::string_view> light_sampling_names();
/// Throws UsageError that lists the names.
[[nodiscard]] LightSampling light_sampling_from_name(std::string_view name);

}  // namespace grove
