#pragma once

#include <cstddef>
#include <cstdint>

#include "grove/registry/registry.h"

namespace grove {

enum class GeometryKind : std::uint8_t { triangles, spheres, instances, user };

/// What a look at some of the primitives tells, before anything is built.
struct GeometrySample {
  GeometryKind kind = GeometryKind::triangles;
  std::size_t size = 0;  ///< primitives
  /// Primitives whose box a line meets, and primitives that it hits, on average over lines through the box of the sample, scaled to all primitives.
  double boxes_per_line = 0.0;
  double hits_per_line = 0.0;

  /// How many boxes are met for one primitive that is hit: how badly boxes fit. 1 where no line met anything.
  [[nodiscard]] double boxes_per_hit() const { return hits_per_line > 0.0 ? boxes_per_line / hits_per_line : 1.0; }
};

/// Sends a few hundred random lines through some thousand evenly chosen primitives: a few milliseconds at most, O(1) in the number of primitives. The same for
/// the same geometry.
[[nodiscard]] GeometrySample sample_geometry(const GeometryPointer& geometry);

}  // namespace grove
