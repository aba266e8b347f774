#pragma once

#include <cstdint>

#include "grove/math/vector.h"

namespace grove {

/// Where light is looked for, and from which side it can matter there.
struct LightReceiver {
  enum class Side : std::uint8_t {
    any,    ///< nothing is known of a surface, or there is none: the normal means nothing
    front,  ///< light from behind the normal's side is worth nothing
    both    ///< light from either side counts
  };

  Vec3 position{0.0F};
  Vec3 normal{0.0F, 0.0F, 1.0F};  ///< unit length
  Side side = Side::any;

  LightReceiver() = default;
  explicit LightReceiver(const Vec3& at) : position(at) {}
  LightReceiver(const Vec3& at, const Vec3& facing, Side sides) : position(at), normal(facing), side(sides) {}
};

}  // namespace grove
