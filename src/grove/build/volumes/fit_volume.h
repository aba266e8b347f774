#pragma once

#include "grove/accel/volume_bvh.h"
#include "grove/build/volumes/extremal_points.h"
#include "grove/build/volumes/hulls.h"

namespace grove {

/// What a volume is to be fitted around, in unit space.
struct FitTask {
  const ExtremalPoints& extremal;  ///< of the hulls
  HullRange hulls;
  /// A box known to be enough. It may be less than the hulls where they were cut to pieces: a volume must enclose the hulls or this box.
  Box box;
};

/// A small volume for a task. O(hulls); the same for any number of threads.
template <BoundingVolume V>
[[nodiscard]] V fit_volume(const FitTask& task);

/// In the way of DiTO-14 (Larsson and Källberg, "Fast Computation of Tight-Fitting Oriented Bounding Boxes", 2011); never of more area than the
/// axis-aligned box.
template <>
[[nodiscard]] OrientedBox fit_volume<OrientedBox>(const FitTask& task);

/// Nearly the smallest sphere around the hulls; never of more area than the sphere around the box.
template <>
[[nodiscard]] BoundingSphere fit_volume<BoundingSphere>(const FitTask& task);

}  // namespace grove
