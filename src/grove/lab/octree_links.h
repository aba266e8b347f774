#pragma once

// The other way to find neighbours in an octree, which was measured and not taken: at each face of each cell a link to what is behind it, as the ropes of
// kd-trees (Popov, Günther, Seidel and Slusallek 2007). It takes 48 bytes a cell, empty ones too, where climbing (traverse/octree_neighbour_traversal.h) takes none.

#include <cstdint>

#include "grove/traverse/octree_neighbour_traversal.h"

namespace grove {

/// What is behind a face: a node, or a cell by the number of its node and octant.
class OctreeLink {
 public:
  OctreeLink() = default;
  [[nodiscard]] static OctreeLink node(std::uint32_t number) { return OctreeLink(number << 4U | kNode); }
  [[nodiscard]] static OctreeLink cell(std::uint32_t node, std::uint32_t octant) { return OctreeLink(node << 4U | octant); }
  [[nodiscard]] static OctreeLink outside() { return OctreeLink(kOutside); }

  [[nodiscard]] bool is_node() const { return (word_ & kNode) != 0; }
  [[nodiscard]] bool is_outside() const { return word_ == kOutside; }
  [[nodiscard]] std::uint32_t number() const { return word_ >> 4U; }
  [[nodiscard]] std::uint32_t octant() const { return word_ & 7U; }

 private:
  static constexpr std::uint32_t kNode = 8;
  static constexpr std::uint32_t kOutside = 0xffffffffU;
  explicit OctreeLink(std::uint32_t word) : word_(word) {}
  std::uint32_t word_ = 0;
};

/// The cells of an octree with their links; octant o of node n is cell 8 * n + o. Of octants that are nodes nothing is kept.
struct OctreeLinks {
  struct Cell {
    Box box;
    OctreeLink links[6];  // behind the lower x, upper x, lower y, upper y, lower z, upper z face
  };
  HugeVector<Cell> cells;

  [[nodiscard]] std::size_t memory() const { return cells.size() * sizeof(Cell); }
};

/// For an octree of less than 2^28 nodes, with all references in leaves. O(nodes * depth).
[[nodiscard]] OctreeLinks link_octree(const Octree& tree);

/// As walk_by_neighbours, by links.
template <typename LeafTest, typename C>
void walk_by_links(const Octree& tree, const OctreeLinks& links, const Ray& ray, const float& t_max, const LeafTest& leaf, C& counter) {
  if (tree.nodes.empty()) return;
  const OctreeRay octree_ray(ray, tree.bounds);
  float first = ray.t_min > 0.0F ? ray.t_min : 0.0F;
  float last = t_max;
  octree_ray.clip(tree.bounds, first, last);
  if (!(first <= last)) return;
  const auto from_the_top = [&](float start) {
    walk_top_down(tree, octree_ray, start > first ? start : first, t_max < last ? t_max : last, t_max, leaf, counter);
  };

  OctreeCrossing crossing{first, octree_ray.last_entry(tree.bounds, first)};
  OctreeLink at = OctreeLink::node(0);
  for (;;) {
    while (at.is_node()) {
      counter.visit_node();
      const OctreeNode& node = tree.nodes[at.number()];
      const OctreeChoice choice(octree_ray, node, crossing);
      if (!choice.is_certain) return from_the_top(crossing.first);
      const std::uint32_t octant = choice.octant ^ octree_ray.flip;
      const bool is_node = (node.interior_mask >> octant & 1U) != 0;
      at = is_node ? OctreeLink::node(node.child(octant)) : OctreeLink::cell(at.number(), octant);
    }
    counter.visit_node();
    const OctreeNode& node = tree.nodes[at.number()];
    if ((node.leaf_mask >> at.octant() & 1U) != 0) {
      counter.enter_leaf();
      const std::uint32_t number = node.leaf(at.octant());
      if (leaf(tree.leaf_first[number], tree.leaf_first[number + 1] - tree.leaf_first[number])) return;
    }
    const OctreeLinks::Cell& cell = links.cells[std::size_t{at.number()} * 8 + at.octant()];
    Vec3 far;
    for (int axis = 0; axis < 3; ++axis) far[axis] = (octree_ray.flip >> axis & 1U) != 0 ? cell.box.lower[axis] : cell.box.upper[axis];
    const OctreeWayOut out(octree_ray, to_float4(far));
    if (out.crossing.first > t_max || out.crossing.first > last) return;
    if (!(out.is_certain && out.crossing.last > crossing.last))
      return from_the_top(out.crossing.first > crossing.first ? out.crossing.first : crossing.first);
    at = cell.links[2 * out.axis + ((octree_ray.flip >> out.axis & 1U) != 0 ? 0 : 1)];
    if (at.is_outside()) return;
    crossing = out.crossing;
  }
}

}  // namespace grove
