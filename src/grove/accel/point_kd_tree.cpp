#include "grove/accel/point_kd_tree.h"

#include <utility>
#include <vector>

namespace grove {
namespace {

template <std::size_t kDimensions>
std::string fault_of_point(const PointKdTree<kDimensions>& tree, std::size_t leaf, std::uint32_t lane) {
  const auto coordinate = [&](std::size_t axis) { return tree.blocks[leaf].coordinates[axis][lane]; };
  for (std::size_t axis = 0; axis < kDimensions; ++axis)
    if (!(coordinate(axis) >= tree.lower[axis] && coordinate(axis) <= tree.upper[axis])) return "a point is outside the bounds";
  for (std::size_t node = tree.nodes.size() + leaf; node > 0;) {
    const bool is_upper = node % 2 == 0;
    node = (node - 1) / 2;
    const PointKdNode& above = tree.nodes[node];
    const float c = coordinate(above.axis);
    if (is_upper ? !(c >= above.upper_begin) : !(c <= above.lower_end))
      return "a point is on the wrong side of node " + std::to_string(node);
  }
  return "";
}

}  // namespace

template <std::size_t kDimensions>
std::string PointKdTree<kDimensions>::validate(std::size_t point_count) const {
  if (blocks.empty()) return size == 0 && nodes.empty() && ids.empty() && depth == 0 ? "" : "an empty tree has nodes";
  if (depth > kMaxDepth || blocks.size() != std::size_t{1} << depth || nodes.size() + 1 != blocks.size() ||
      ids.size() != kLeafSize * blocks.size())
    return "nodes, blocks and numbers do not fit together";
  for (const PointKdNode& node : nodes)
    if (node.axis >= kDimensions || !(node.lower_end <= node.upper_begin)) return "a node has no such axis, or its sides overlap";
  std::vector<bool> is_there(point_count, false);
  std::size_t found = 0;
  for (std::size_t leaf = 0; leaf < blocks.size(); ++leaf) {
    for (std::uint32_t lane = 0; lane < kLeafSize; ++lane) {
      const std::uint32_t id = ids[leaf * kLeafSize + lane];
      if (id == kNoPoint) {
        if (blocks[leaf].coordinates[0][lane] == blocks[leaf].coordinates[0][lane]) return "a lane without a point is not NaN";
        continue;
      }
      if (id >= point_count || is_there[id]) return "point " + std::to_string(id) + " is not there, or there twice";
      is_there[id] = true;
      ++found;
      std::string fault = fault_of_point(*this, leaf, lane);
      if (!fault.empty()) return fault;
    }
  }
  return found == size ? "" : "there are " + std::to_string(found) + " points, not " + std::to_string(size) + " as stated";
}

template struct PointKdTree<2>;
template struct PointKdTree<3>;
template struct PointKdTree<4>;
template struct PointKdTree<5>;
template struct PointKdTree<6>;
template struct PointKdTree<7>;
template struct PointKdTree<8>;
template struct PointKdTree<9>;
template struct PointKdTree<10>;
template struct PointKdTree<11>;
template struct PointKdTree<12>;
template struct PointKdTree<13>;
template struct PointKdTree<14>;
template struct PointKdTree<15>;
template struct PointKdTree<16>;

}  // namespace grove
