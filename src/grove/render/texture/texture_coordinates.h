#pragma once

#include <array>
#include <cstdint>

#include "grove/math/vector.h"

namespace grove {

/// Where a surface point lies in the sets of texture coordinates that its mesh has.
struct TextureCoordinates {
  std::array<Vec2, 2> sets{Vec2(0.0F), Vec2(0.0F)};

  TextureCoordinates() = default;
  // Implicit, since most meshes have one set, which then serves all textures.
  // NOLINTNEXTLINE(google-explicit-constructor)
  TextureCoordinates(const Vec2& uv) : sets{uv, uv} {}
  TextureCoordinates(float u, float v) : TextureCoordinates(Vec2(u, v)) {}
  TextureCoordinates(const Vec2& first, const Vec2& second) : sets{first, second} {}

  /// The first for sets that are not kept.
  [[nodiscard]] const Vec2& of(std::uint32_t set) const { return sets[set < sets.size() ? set : 0]; }
};

}  // namespace grove
