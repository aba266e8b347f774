#pragma once

#include <cstdint>

namespace grove {

/// Which of the children that a ray meets a walk enters first.
enum class WalkOrder : std::uint8_t {
  nearest_first,  ///< for the closest hit
  largest_first,  ///< for any hit: where the surface of the box is largest, a hit is likeliest
};

}  // namespace grove
