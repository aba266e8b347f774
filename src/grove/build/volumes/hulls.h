#pragma once

// The hulls that volumes are fitted around, gathered in the order of a hierarchy's references, so that the hulls of a subtree are one stretch
// of memory.

#include <cstddef>
#include <cstdint>
#include <span>

#include "grove/base/huge_vector.h"
#include "grove/base/parallel.h"
#include "grove/geometry/enclosing_hull.h"
#include "grove/math/oriented_box.h"
#include "grove/math/unit_space.h"

namespace grove {

struct HullList {
  std::size_t points_per_hull = 0;
  HugeVector<Vec3> points;  ///< in the scene's coordinates, as they are, so that nothing is rounded
  HugeVector<float> radii;  ///< one a hull; empty where none has any
};

/// Gathers the hulls of `references`, in parallel. 12 bytes a point: 36 a triangle, 16 a sphere, 96 where boxes stand for primitives.
template <EnclosableGeometry G>
[[nodiscard]] HullList list_hulls(const G& geometry, std::span<const std::uint32_t> references) {
  using Hull = decltype(enclosing_hull(geometry, 0));
  HullList list;
  list.points_per_hull = static_cast<std::size_t>(Hull::kPointCount);
  list.points.resize(references.size() * list.points_per_hull);
  if (Hull::kPointCount == 1) list.radii.resize(references.size());
  parallel_for(references.size(), 16384, [&](std::size_t i) {
    const Hull hull = enclosing_hull(geometry, references[i]);
    std::copy_n(hull.points, list.points_per_hull, list.points.data() + i * list.points_per_hull);
    if (!list.radii.empty()) list.radii[i] = hull.radius;
  });
  return list;
}

/// The hulls [first, first + count) of a list, seen from unit space. Large ranges are gone through in parallel; the results are the same for any
/// number of threads.
class HullRange {
 public:
  HullRange(const HullList& list, const UnitSpace& space, std::size_t first, std::size_t count)
      : list_(list), space_(space), first_(first), count_(count) {}

  /// Makes the planes of `box` touch the hulls, with its axes as they are: the box contains them all.
  void fit_planes(OrientedBox& box) const;

  struct Farthest {
    glm::dvec3 point;
    double distance;
  };
  /// The point of the hulls that is farthest from `centre`, the first of equals.
  [[nodiscard]] Farthest farthest_from(const Vec3& centre) const;

  /// Calls visitor(point, radius) for the points of all hulls in unit space.
  template <typename Visitor>
  void visit_points(const Visitor& visitor) const {
    visit_points(first_, first_ + count_, visitor);
  }

 private:
  template <typename Visitor>
  void visit_points(std::size_t first, std::size_t last, const Visitor& visitor) const {
    const std::size_t n = list_.points_per_hull;
    if (list_.radii.empty()) {
      for (std::size_t i = first * n; i < last * n; ++i) visitor(space_.to_unit(list_.points[i]), 0.0);
    } else {
      for (std::size_t i = first * n; i < last * n; ++i) visitor(space_.to_unit(list_.points[i]), list_.radii[i / n] * space_.scale);
    }
  }

  const HullList& list_;
  const UnitSpace& space_;
  std::size_t first_;
  std::size_t count_;
};

}  // namespace grove
