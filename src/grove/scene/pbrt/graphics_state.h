#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "grove/scene/pbrt/description.h"

namespace grove::pbrt {

/// What an Attribute directive can give parameters to.
enum class AttributeTarget : std::uint8_t { shape, light, material, medium, texture };
inline constexpr std::size_t kAttributeTargetCount = 5;

using AttributeDefaults = std::array<std::shared_ptr<const std::vector<Parameter>>, kAttributeTargetCount>;

/// What AttributeBegin saves and AttributeEnd brings back.
struct GraphicsState {
  Matrix transform{1.0};
  /// Of the two transforms of a moving scene we keep that of the shutter's opening; false while only the other is being changed.
  bool changes_start = true;
  bool reverse_orientation = false;
  ColourSpace colour_space = ColourSpace::srgb;
  std::uint32_t material = 0;
  std::uint32_t area_light = kNone;
  std::shared_ptr<const AttributeDefaults> defaults;
};

}  // namespace grove::pbrt
