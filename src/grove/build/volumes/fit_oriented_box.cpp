// Oriented boxes by the "ditetrahedron" of DiTO-14 (Larsson and Källberg 2011). Among the extremal points a large triangle is looked for, and
// the farthest points on both sides of it. Of the two tetrahedra that they make, each face and each of its edges gives a frame. The frame
// whose box around the extremal points has the least area is kept, and its planes are moved to touch all primitives.
//
// Differences from the paper: the points on both sides of the triangle are looked for among the extremal points too, so that a fit goes over the
// primitives once; and the axis-aligned box is the node's, which may be less than what the primitives need.

#include <cmath>
#include <limits>

#include "grove/build/volumes/fit_volume.h"
#include "grove/math/float4.h"

namespace grove {
namespace {

// Below this length a thing counts as without extent, beside a set of size 1.
constexpr float kNothing = 1e-6F;

struct Frame {
  Vec3 axes[3];
};

// The extremal points, moved and scaled so that the longest of their distances along the seven directions is 1. Finds the best frame.
class FrameSearch {
 public:
  explicit FrameSearch(const ExtremalPoints& extremal) {
    double longest = 0.0;
    for (int i = 0; i < ExtremalPoints::kCount; i += 2) {
      const double length = glm::length(extremal[i + 1] - extremal[i]);
      if (length <= longest) continue;
      longest = length;
      base_ = i;
    }
    size_ = longest;
    if (!(longest > 0.0)) return;
    for (int i = 0; i < kLanes; ++i) {
      // The last places repeat the first, which changes nothing.
      points_[i] = Vec3((extremal[i % ExtremalPoints::kCount] - extremal[base_]) / longest);
      for (int axis = 0; axis < 3; ++axis) coordinates_[axis][i / 4][i % 4] = points_[i][axis];
    }
  }

  // Half the area of the best frame's box around the extremal points, in units of unit space; infinite where the points are all the same.
  [[nodiscard]] double run(Frame& best) {
    if (!(size_ > 0.0)) return std::numeric_limits<double>::infinity();
    const Vec3& p0 = points_[base_];
    const Vec3& p1 = points_[base_ + 1];
    const Vec3 along = p1 - p0;
    const Vec3& p2 = farthest([&](const Vec3& p) {
      const Vec3 off = glm::cross(p - p0, along);
      return glm::dot(off, off);
    });
    const Vec3 normal = glm::cross(along, p2 - p0);
    const float height = glm::length(normal);
    if (height < kNothing) {
      try_line(along);
    } else {
      const Vec3 up = normal / height;
      try_triangle(p0, p1, p2);
      for (const float side : {1.0F, -1.0F}) {
        const Vec3& apex = farthest([&](const Vec3& p) { return side * glm::dot(p - p0, up); });
        if (side * glm::dot(apex - p0, up) < kNothing) continue;
        try_triangle(p0, p1, apex);
        try_triangle(p1, p2, apex);
        try_triangle(p2, p0, apex);
      }
    }
    best = best_;
    return static_cast<double>(least_area_) * size_ * size_;
  }

 private:
  static constexpr int kLanes = 16;

  // The first point of the largest measure.
  template <typename Measure>
  const Vec3& farthest(const Measure& measure) const {
    int best = 0;
    float most = measure(points_[0]);
    for (int i = 1; i < ExtremalPoints::kCount; ++i) {
      const float m = measure(points_[i]);
      if (!(m > most)) continue;
      most = m;
      best = i;
    }
    return points_[best];
  }

  // Any frame around a direction.
  void try_line(const Vec3& along) {
    const Vec3 u = glm::normalize(along);
    const Vec3 other = std::fabs(u.x) < 0.6F ? Vec3(1.0F, 0.0F, 0.0F) : Vec3(0.0F, 1.0F, 0.0F);
    const Vec3 v = glm::normalize(glm::cross(u, other));
    try_frame({{u, v, glm::cross(u, v)}});
  }

  // The frames of a triangle's normal and one of its edges.
  void try_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 cross = glm::cross(b - a, c - a);
    const float length = glm::length(cross);
    if (length < kNothing) return;
    const Vec3 normal = cross / length;
    const Vec3 edges[3] = {b - a, c - b, a - c};
    for (const Vec3& edge : edges) {
      const Vec3 u = glm::normalize(edge);
      try_frame({{u, glm::cross(normal, u), normal}});
    }
  }

  void try_frame(const Frame& frame) {
    float side[3];
    for (int axis = 0; axis < 3; ++axis) side[axis] = extent_along(frame.axes[axis]);
    const float area = side[0] * (side[1] + side[2]) + side[1] * side[2];
    if (!(area < least_area_)) return;
    least_area_ = area;
    best_ = frame;
  }

  [[nodiscard]] float extent_along(const Vec3& axis) const {
    Float4 low = splat(std::numeric_limits<float>::infinity());
    Float4 high = splat(-std::numeric_limits<float>::infinity());
    for (int group = 0; group < kLanes / 4; ++group) {
      const Float4 p =
          coordinates_[0][group] * splat(axis.x) + coordinates_[1][group] * splat(axis.y) + coordinates_[2][group] * splat(axis.z);
      low = min(p, low);
      high = max(p, high);
    }
    // Minima as maxima of what is turned over, so that one reduction serves both.
    const Float4 halves = max(__builtin_shufflevector(high, -low, 0, 1, 4, 5), __builtin_shufflevector(high, -low, 2, 3, 6, 7));
    const Float4 ends = max(halves, __builtin_shufflevector(halves, halves, 1, 0, 3, 2));
    return ends[0] + ends[2];
  }

  Vec3 points_[kLanes];
  Float4 coordinates_[3][kLanes / 4];
  int base_ = 0;  // the longest pair is base_, base_ + 1
  double size_ = 0.0;
  float least_area_ = std::numeric_limits<float>::infinity();
  Frame best_{};
};

}  // namespace

template <>
OrientedBox fit_volume<OrientedBox>(const FitTask& task) {
  const OrientedBox aligned = OrientedBox::aligned(task.box);
  Frame frame;
  // The extremal points need no more room than all do: a frame that loses already has lost.
  if (FrameSearch(task.extremal).run(frame) >= static_cast<double>(aligned.half_area())) return aligned;
  OrientedBox oriented{};
  for (int axis = 0; axis < 3; ++axis)
    for (int component = 0; component < 3; ++component) oriented.axes[component][axis] = frame.axes[axis][component];
  task.hulls.fit_planes(oriented);
  return oriented.half_area() < aligned.half_area() ? oriented : aligned;
}

}  // namespace grove
