#include "grove/build/hierarchy_part.h"

#include "grove/base/parallel.h"

namespace grove {
namespace {

// Gives each part its place in depth-first order; returns the end.
std::uint32_t place(HierarchyPart& part, std::uint32_t offset) {
  part.offset = offset;
  if (part.children[0] == nullptr) return offset + static_cast<std::uint32_t>(part.nodes.size());
  return place(*part.children[1], place(*part.children[0], offset + 1));
}

Bvh2Node::Child copy_nodes(HierarchyPart& part, Bvh2Node* nodes) {
  if (part.is_leaf()) return part.link;
  if (part.children[0] == nullptr) {
    for (std::size_t i = 0; i < part.nodes.size(); ++i) {
      Bvh2Node node = part.nodes[i];
      for (int child = 0; child < 2; ++child)
        if (node.child[child].count == 0) node.child[child].first += part.offset;
      nodes[part.offset + i] = node;
    }
    part.nodes = {};
    return {part.offset, 0};
  }
  Bvh2Node::Child children[2];
  parallel_invoke([&] { children[0] = copy_nodes(*part.children[0], nodes); }, [&] { children[1] = copy_nodes(*part.children[1], nodes); });
  Bvh2Node& node = nodes[part.offset];
  set_children(node, part.bounds[0], part.bounds[1]);
  node.child[0] = children[0];
  node.child[1] = children[1];
  return {part.offset, 0};
}

}  // namespace

void set_children(Bvh2Node& node, const Box4& left, const Box4& right) {
  for (int axis = 0; axis < 3; ++axis) {
    node.planes[axis][0] = left.lower[axis];
    node.planes[axis][1] = right.lower[axis];
    node.planes[axis][2] = left.upper[axis];
    node.planes[axis][3] = right.upper[axis];
  }
}

void assemble(HierarchyPart& root, Bvh2& bvh) {
  bvh.depth = root.depth;
  bvh.nodes.resize(place(root, 0));
  copy_nodes(root, bvh.nodes.data());
}

}  // namespace grove
