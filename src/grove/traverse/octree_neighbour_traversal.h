#pragma once

// The ray generator of the review (Glassner 1984, "Space Subdivision for Fast Ray Tracing"; Endl and Sommer 1994, "Classification of Ray-Generators in Uniform
// Subdivisions and Octrees for Ray Tracing"): from the cell that the ray is in through one of its faces into the neighbour, until something is hit. Neighbours
// are found from integer coordinates (Samet 1989, "Neighbor Finding in Images Represented by Octrees"): along each axis, a cell's coordinate has one
// bit a level, set where the ray is behind the plane. To leave a cell through the face that it comes to next is to add one, and how far the carry goes is how many
// levels there are to climb: O(1) expected. From there the ray goes down again, side by side with the face it came through, by where it is with regard to the planes;
// so planes may be anywhere (octree-R).
//
// One path of cells is enough only where there is no doubt about it, as with the ropes of kd-trees (kd_rope_traversal.h): a plane is a band for a ray, so
// crossing a face takes a stretch of t, the crossing, during which the ray must be outside the bands of all other planes that matter. Where that is in doubt (rays
// through edges and corners of cells, in planes, or cells smaller than rounding), the walk from the top takes over from the start of the crossing. Before it,
// everything has been tested; so the hits are the same, and no ray is moved by an epsilon.
//
// The walk ends: the end of each crossing is later than that of the one before, or there is doubt. The end of a crossing out of a cell is a function of the ray and
// the cell alone, so no cell is come to twice, and there are finitely many.

#include <bit>
#include <cstdint>

#include "grove/traverse/octree_traversal.h"

namespace grove {

/// The stretch of a ray in which it may be on both sides of a face.
struct OctreeCrossing {
  float first, last;
};

/// Where a ray goes from a cell: through one face, or undecided.
struct OctreeWayOut {
  OctreeCrossing crossing;
  std::uint32_t axis = 0;
  bool is_certain;

  /// `far` holds the planes of the three faces through which the ray may leave.
  OctreeWayOut(const OctreeRay& ray, Float4 far) {
    const Float4 entry = ray.entry(far);
    const Float4 departure = ray.departure(far);
    if (entry[1] < entry[0]) axis = 1;
    if (entry[2] < entry[axis]) axis = 2;
    crossing = {entry[axis], departure[axis]};
    // Written so that NaN is doubt.
    is_certain = crossing.first <= crossing.last && crossing.last < entry[(axis + 1) % 3] && crossing.last < entry[(axis + 2) % 3];
  }
};

/// In which octant of a node a ray is during all of a crossing, and whether that is sure.
struct OctreeChoice {
  std::uint32_t octant;  // by number as the ray comes to them
  bool is_certain;

  OctreeChoice(const OctreeRay& ray, const OctreeNode& node, const OctreeCrossing& crossing) {
    const Float4 planes = planes_of(node);
    const auto before = static_cast<std::uint32_t>(first_three_lanes(splat(crossing.last) < ray.entry(planes)));
    const auto behind = static_cast<std::uint32_t>(first_three_lanes(splat(crossing.first) > ray.departure(planes)));
    // Where the cell is not cut all is below the plane.
    const std::uint32_t uncut = ~std::uint32_t{node.cut_axes} & 7U;
    octant = (behind & ~uncut) | (ray.flip & uncut);
    is_certain = (before | behind | uncut) == 7;
  }
};

/// The nodes above the cell that a ray is in.
class OctreePath {
 public:
  OctreePath(const Octree& tree, const OctreeRay& ray) : nodes_(tree.nodes.data()), ray_(ray) {
    Vec3 far;
    for (int axis = 0; axis < 3; ++axis) far[axis] = (ray.flip >> axis & 1U) != 0 ? tree.cell.lower[axis] : tree.cell.upper[axis];
    levels_[0] = {to_float4(far), 0, 0};
  }

  [[nodiscard]] std::uint32_t number() const { return levels_[level_].node; }
  [[nodiscard]] const OctreeNode& node() const { return nodes_[levels_[level_].node]; }

  /// Goes to an octant of the node. Returns whether that is a node; else it is the cell that far() is about.
  bool enter(std::uint32_t octant) {
    Level& level = levels_[level_];
    const OctreeNode& parent = nodes_[level.node];
    level.octant = octant;
    // Nothing lies behind an octant that is behind its plane, nor where the cell is not cut: the faces are the parent's.
    const std::uint32_t last = octant | (~std::uint32_t{parent.cut_axes} & 7U);
    const std::uint32_t bit = bit_of(level_);
    for (std::uint32_t axis = 0; axis < 3; ++axis) coordinate_[axis] = (coordinate_[axis] & ~bit) | ((last >> axis & 1U) != 0 ? bit : 0U);
    far_ = select(last, level.far, planes_of(parent));
    const std::uint32_t number = octant ^ ray_.flip;
    if ((parent.interior_mask >> number & 1U) == 0) return false;
    levels_[++level_] = {far_, parent.child(number), 0};
    return true;
  }

  /// The planes of the faces through which the ray may leave the cell.
  [[nodiscard]] Float4 far() const { return far_; }
  /// Of the node: where the cell lies in it.
  [[nodiscard]] std::uint32_t octant() const { return levels_[level_].octant ^ ray_.flip; }

  /// Climbs to the node that has the neighbour across an axis in another octant, which is returned; 8 where there is none.
  std::uint32_t climb(std::uint32_t axis) {
    const auto climbed = static_cast<std::uint32_t>(std::countr_one(coordinate_[axis] >> shift_of(level_)));
    if (climbed > level_) return 8;
    level_ -= climbed;
    return levels_[level_].octant | 1U << axis;
  }

 private:
  struct Level {
    Float4 far;  // the planes of the faces through which the ray may leave the node's cell
    std::uint32_t node;
    std::uint32_t octant;
  };

  static std::uint32_t shift_of(std::uint32_t level) { return Octree::kMaxDepth - 1 - level; }
  static std::uint32_t bit_of(std::uint32_t level) { return 1U << shift_of(level); }

  // Lanes of `a` where bits of the mask are set, of `b` elsewhere.
  static Float4 select(std::uint32_t mask, Float4 a, Float4 b) {
    const Int4 lanes = Int4{1, 2, 4, 8} & static_cast<std::int32_t>(mask);
    return lanes != 0 ? a : b;
  }

  const OctreeNode* nodes_;
  const OctreeRay& ray_;
  Float4 far_{};
  std::uint32_t level_ = 0;
  std::uint32_t coordinate_[3] = {0, 0, 0};
  Level levels_[Octree::kMaxDepth + 1];
};

/// As `walk`, from cell to neighbouring cell. The counter counts cells that are passed through as nodes, too: leaving one takes as long.
template <typename LeafTest, typename C>
void walk_by_neighbours(const Octree& tree, const Ray& ray, const float& t_max, const LeafTest& leaf, C& counter) {
  if (tree.nodes.empty()) return;
  const OctreeRay octree_ray(ray, tree.bounds);
  const float from = ray.t_min > 0.0F ? ray.t_min : 0.0F;
  float first = from;
  float last = t_max;
  octree_ray.clip(tree.bounds, first, last);
  if (!(first <= last)) return;

  // Coming into the tree is a crossing too, of up to three faces.
  OctreeCrossing crossing{first, octree_ray.last_entry(tree.bounds, first)};
  const std::uint32_t* const leaf_first = tree.leaf_first.data();
  const auto test = [&](std::uint32_t number) {
    count_leaf(counter, leaf_first[number]);
    return leaf(leaf_first[number], leaf_first[number + 1] - leaf_first[number]);
  };
  OctreePath path(tree, octree_ray);
  for (bool is_node = true;;) {
    while (is_node) {
      count_node(counter, path.number());
      const OctreeNode& node = path.node();
      if (node.has_own != 0 && test(node.first_leaf)) return;
      const OctreeChoice choice(octree_ray, node, crossing);
      if (!choice.is_certain) {
        walk_top_down(tree, octree_ray, crossing.first > first ? crossing.first : first, t_max < last ? t_max : last, t_max, leaf, counter);
        return;
      }
      is_node = path.enter(choice.octant);
    }
    const OctreeNode& node = path.node();
    const std::uint32_t octant = path.octant();
    if ((node.leaf_mask >> octant & 1U) != 0) {
      count_cell(counter, leaf_first[node.leaf(octant)]);
      if (test(node.leaf(octant))) return;
    } else {
      count_gap(counter, path.number(), octant);
    }
    const OctreeWayOut out(octree_ray, path.far());
    // Whatever is left lies beyond. A tie must still be looked for.
    if (out.crossing.first > t_max || out.crossing.first > last) return;
    if (!(out.is_certain && out.crossing.last > crossing.last)) {
      crossing.first = out.crossing.first > crossing.first ? out.crossing.first : crossing.first;
      walk_top_down(tree, octree_ray, crossing.first > first ? crossing.first : first, t_max < last ? t_max : last, t_max, leaf, counter);
      return;
    }
    const std::uint32_t next = path.climb(out.axis);
    if (next == 8) return;
    crossing = out.crossing;
    is_node = path.enter(next);
  }
}

}  // namespace grove
