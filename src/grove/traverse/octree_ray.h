#pragma once

// A ray as the nodes of an octree see it: planes are bands, as for kd-trees (kd_ray.h tells what `entry` and `departure` mean), three at a time.

#include <array>
#include <cstdint>

#include "grove/accel/octree.h"
#include "grove/math/float4.h"
#include "grove/traverse/slab_ray.h"

namespace grove {

/// Octants are numbered here as the ray comes to them: bit a is set for those behind the plane across axis a. `flip` turns such a number into that of the
/// octree, and back, by exclusive or. In order of their numbers, octants come front to back: of two that a ray passes through, the one that it leaves for the
/// other lies behind fewer planes.
struct OctreeRay {
  Float4 origin_near, inverse_near, origin_far, inverse_far;
  std::uint32_t flip = 0;

  OctreeRay(const Ray& ray, const Box& bounds) {
    const SlabRay slabs(ray, bounds);
    origin_near = load3(slabs.origin_near);
    inverse_near = load3(slabs.inverse_near);
    origin_far = load3(slabs.origin_far);
    inverse_far = load3(slabs.inverse_far);
    for (std::uint32_t axis = 0; axis < 3; ++axis) flip |= slabs.negative[axis] ? 1U << axis : 0U;
  }

  /// The first t at which the ray may meet something behind each plane, or NaN, which sets no limit.
  [[nodiscard]] Float4 entry(Float4 planes) const { return (planes - origin_near) * inverse_near; }
  /// The last t at which it may meet something before each plane, or NaN.
  [[nodiscard]] Float4 departure(Float4 planes) const { return (planes - origin_far) * inverse_far; }

  /// Narrows [first, last] to the stretch of the ray that may meet something in the box. Empty (first > last) where it passes by.
  void clip(const Box& box, float& first, float& last) const {
    Vec3 near;
    Vec3 far;
    for (int axis = 0; axis < 3; ++axis) {
      const bool is_negative = (flip >> axis & 1U) != 0;
      near[axis] = is_negative ? box.upper[axis] : box.lower[axis];
      far[axis] = is_negative ? box.lower[axis] : box.upper[axis];
    }
    const Float4 into = entry(to_float4(near));
    const Float4 out = departure(to_float4(far));
    for (int axis = 0; axis < 3; ++axis) {
      first = into[axis] > first ? into[axis] : first;
      last = out[axis] < last ? out[axis] : last;
    }
  }

  /// Where the ray has come in through all faces of the box that it meets from outside; `first` where it is inside by then.
  [[nodiscard]] float last_entry(const Box& box, float first) const {
    Vec3 near;
    for (int axis = 0; axis < 3; ++axis) near[axis] = (flip >> axis & 1U) != 0 ? box.upper[axis] : box.lower[axis];
    const Float4 inside = departure(to_float4(near));
    float last = first;
    // Written so that NaN spoils the answer: then nothing is certain.
    for (int axis = 0; axis < 3; ++axis)
      if (!(inside[axis] <= last)) last = inside[axis];
    return last;
  }

  /// A mask of octants by their numbers in the octree as one by the numbers here, or the other way round.
  [[nodiscard]] std::uint32_t flipped(std::uint32_t mask) const {
    static constexpr std::array<std::array<std::uint8_t, 256>, 8> kFlipped = [] {
      std::array<std::array<std::uint8_t, 256>, 8> table{};
      for (unsigned by = 0; by < 8; ++by)
        for (unsigned set = 0; set < 256; ++set)
          for (unsigned octant = 0; octant < 8; ++octant)
            table[by][set] = static_cast<std::uint8_t>(table[by][set] | (set >> octant & 1U) << (octant ^ by));
      return table;
    }();
    return kFlipped[flip][mask];
  }

 private:
  static Float4 load3(const float* p) { return Float4{p[0], p[1], p[2], 0.0F}; }
};

/// The planes of a node, in three lanes.
[[nodiscard]] inline Float4 planes_of(const OctreeNode& node) {
  return without_last_lane(load4(node.planes));
}

/// Where each octant of a node lies along a ray: octant o in [first[o], last[o]], if at all.
struct OctantStretches {
  float first[8];
  float last[8];

  /// Cuts [from, to], the stretch in the cell, at the planes of `node`. Returns which octants have something of it, by number as the ray comes to them.
  std::uint32_t cut(const OctreeRay& ray, Float4 planes, float from, float to) {
    const Float4 from4 = splat(from);
    const Float4 to4 = splat(to);
    // Octants behind a plane begin at its entry, those before it end at its departure. max and min keep the other where one is NaN.
    const Float4 entry = max(ray.entry(planes), from4);
    const Float4 departure = min(ray.departure(planes), to4);
    // Octants 0 to 3, before the plane across z; 4 to 7 lie behind it.
    const Float4 begin = max(__builtin_shufflevector(from4, entry, 0, 4, 0, 4), __builtin_shufflevector(from4, entry, 0, 0, 5, 5));
    const Float4 end = min(__builtin_shufflevector(departure, to4, 0, 4, 0, 4), __builtin_shufflevector(departure, to4, 1, 1, 4, 4));
    const Float4 near_end = min(end, splat(departure[2]));
    const Float4 far_begin = max(begin, splat(entry[2]));
    store4(begin, first);
    store4(far_begin, first + 4);
    store4(near_end, last);
    store4(end, last + 4);
    return static_cast<std::uint32_t>(four_lanes(begin <= near_end) | four_lanes(far_begin <= end) << 4);
  }
};

}  // namespace grove
