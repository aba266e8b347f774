#pragma once

#include <cstdint>

#include "grove/geometry/ray.h"

namespace grove {

/// A ray that an integrator asked a structure about.
struct RecordedRay {
  Ray ray;
  /// Surfaces that scattered light between the camera and this ray's origin: 0 for camera rays; 1 for what leaves the first surface, towards a
  /// light or on the path; and so on. Passing through what only lets light through does not count.
  std::uint32_t bounce = 0;
  bool asks_any = false;  ///< whether any hit was asked for, else the closest
};

}  // namespace grove
