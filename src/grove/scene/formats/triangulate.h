#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "grove/math/vector.h"

namespace grove {

/// A polygon with more corners than this is taken only if it is convex: clipping ears takes a time that grows with the square.
inline constexpr std::size_t kMaxConcaveCorners = 10000;

/// Cuts planar (or nearly planar) simple polygons into triangles; keeps its scratch memory from one polygon to the next.
///
/// Triangles and convex polygons become fans. Others lose one ear after the other (Meisters 1975, "Polygons have ears") in the plane
/// in which their area is largest. A polygon that crosses itself still gives corners - 2 triangles, which then overlap.
class Triangulator {
 public:
  /// The triangles as positions in `corners`, with the polygon's winding, valid until the next call: always corners.size() - 2, none for
  /// fewer than three corners. Throws InputError naming nothing but the polygon when it is concave and above kMaxConcaveCorners.
  std::span<const std::array<std::uint32_t, 3>> triangulate(std::span<const Vec3> corners);

 private:
  void fan(std::uint32_t count);
  bool project(std::span<const Vec3> corners);
  [[nodiscard]] bool is_convex() const;
  void clip_ears();
  [[nodiscard]] bool is_ear(std::uint32_t corner) const;
  void clip(std::uint32_t corner);
  [[nodiscard]] double corner_area(std::uint32_t corner) const;

  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<glm::dvec2> points_;   // turned so that the polygon runs counter-clockwise
  std::vector<std::uint32_t> next_;  // the ring of corners that are left; kGone for the others
  std::vector<std::uint32_t> previous_;
  std::vector<std::uint32_t> reflex_;  // corners that bend inward: only they can lie in an ear
  std::vector<std::uint32_t> candidates_;
};

}  // namespace grove
