#pragma once

#include <array>
#include <cstdint>

#include "grove/geometry/hit.h"

namespace grove {

/// The media that a path is inside of, by the materials of their boundaries, the innermost first. What lies deeper than two is forgotten: a drink in a
/// glass is as deep as scenes go.
class MediumStack {
 public:
  /// kInvalidId outside of all.
  [[nodiscard]] std::uint32_t innermost() const { return materials_[0]; }

  void enter(std::uint32_t material) { materials_ = {material, materials_[0]}; }

  /// Nothing happens when the path is not inside of it: scenes have holes.
  void leave(std::uint32_t material) {
    if (materials_[0] == material) {
      materials_ = {materials_[1], kInvalidId};
    } else if (materials_[1] == material) {
      materials_[1] = kInvalidId;
    }
  }

 private:
  std::array<std::uint32_t, 2> materials_{kInvalidId, kInvalidId};
};

}  // namespace grove
