#include "grove/lab/octree_links.h"

#include "grove/base/check.h"

namespace grove {
namespace {

// A node on the way down, with its cell and what is behind each face of it.
struct Frame {
  std::uint32_t node;
  Box box;
  OctreeLink links[6];
};

class LinkMaker {
 public:
  LinkMaker(const Octree& tree, OctreeLinks& links) : tree_(tree), links_(links) {}

  void make(const Frame& frame) const {
    const OctreeNode& node = tree_.nodes[frame.node];
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
      Frame part{0, node.octant_cell(frame.box, octant), {}};
      for (std::uint32_t face = 0; face < 6; ++face) {
        // Behind a face at one of the node's planes lies another octant, behind the others what lies behind the node.
        const std::uint32_t axis = face / 2;
        const bool is_plane = (octant >> axis & 1U) != face % 2;
        part.links[face] = is_plane ? octant_of(frame.node, octant ^ 1U << axis) : frame.links[face];
      }
      if ((node.interior_mask >> octant & 1U) != 0) {
        part.node = node.child(octant);
        make(part);
        continue;
      }
      OctreeLinks::Cell& cell = links_.cells[std::size_t{frame.node} * 8 + octant];
      cell.box = part.box;
      for (std::uint32_t face = 0; face < 6; ++face) cell.links[face] = push_down(part.links[face], face, part.box);
    }
  }

 private:
  [[nodiscard]] OctreeLink octant_of(std::uint32_t node, std::uint32_t octant) const {
    const bool is_node = (tree_.nodes[node].interior_mask >> octant & 1U) != 0;
    return is_node ? OctreeLink::node(tree_.nodes[node].child(octant)) : OctreeLink::cell(node, octant);
  }

  // The smallest node or cell below `link` that touches all of a face of `box`.
  [[nodiscard]] OctreeLink push_down(OctreeLink link, std::uint32_t face, const Box& box) const {
    while (!link.is_outside() && link.is_node()) {
      const OctreeNode& node = tree_.nodes[link.number()];
      std::uint32_t octant = 0;
      for (std::uint32_t axis = 0; axis < 3; ++axis) {
        const int i = static_cast<int>(axis);
        if (axis == face / 2) {
          // The octant at the face: behind an upper face it is the lower one, as it is where the cell is not cut.
          octant |= face % 2 == 0 && (node.cut_axes >> axis & 1U) != 0 ? 1U << axis : 0U;
        } else if (node.planes[axis] <= box.lower[i]) {
          octant |= 1U << axis;
        } else if (node.planes[axis] < box.upper[i]) {
          return link;
        }
      }
      link = octant_of(link.number(), octant);
    }
    return link;
  }

  const Octree& tree_;
  OctreeLinks& links_;
};

}  // namespace

OctreeLinks link_octree(const Octree& tree) {
  OctreeLinks links;
  if (tree.nodes.empty()) return links;
  GROVE_CHECK(tree.nodes.size() < std::size_t{1} << 28U);
  links.cells.resize(tree.nodes.size() * 8);
  const OctreeLink none = OctreeLink::outside();
  LinkMaker(tree, links).make({0, tree.cell, {none, none, none, none, none, none}});
  return links;
}

}  // namespace grove
