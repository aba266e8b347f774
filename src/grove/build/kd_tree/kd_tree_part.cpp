#include "grove/build/kd_tree/kd_tree_part.h"

#include <algorithm>

#include "grove/base/error.h"
#include "grove/base/parallel.h"

namespace grove {
namespace {

// A part without children, and where it goes: its root to one place, the pairs below it to another.
struct Placement {
  const KdTreePart* part;
  std::size_t root;
  std::size_t pairs;
  std::size_t references;
};

class Assembly {
 public:
  explicit Assembly(const KdTreePart& root) { place(root, 0); }

  [[nodiscard]] KdTree copy() const {
    if (node_count_ > KdTree::kMaxNodes || reference_count_ > 0xfffffffeU)
      throw InputError("the kd-tree would have more than 2^30 nodes; split the geometry into instances, or lower max-depth");
    KdTree tree;
    tree.nodes.resize(node_count_);
    tree.references.resize(reference_count_);
    tree.nodes[1] = KdNode::leaf(0, 0);
    for (const Joint& joint : joints_)
      tree.nodes[joint.node] = KdNode::interior(joint.axis, joint.position, static_cast<std::uint32_t>(joint.pair));
    parallel_for(placements_.size(), 1, [&](std::size_t i) { copy(placements_[i], tree); });
    return tree;
  }

 private:
  struct Joint {
    std::size_t node, pair;
    int axis;
    float position;
  };

  void place(const KdTreePart& part, std::size_t node) {
    if (!part.is_joined()) {
      placements_.push_back({&part, node, node_count_, reference_count_});
      node_count_ += part.nodes.size() - 2;
      reference_count_ += part.references.size();
      return;
    }
    const std::size_t pair = node_count_;
    joints_.push_back({node, pair, part.axis, part.position});
    node_count_ += 2;
    for (int side = 0; side < 2; ++side) place(*part.children[side], pair + static_cast<std::size_t>(side));
  }

  static void copy(const Placement& placement, KdTree& tree) {
    const KdTreePart& part = *placement.part;
    for (std::size_t i = 0; i < part.nodes.size(); ++i) {
      if (i == 1) continue;
      const KdNode node = part.nodes[i];
      tree.nodes[i == 0 ? placement.root : placement.pairs + i - 2] =
          node.is_leaf() ? KdNode::leaf(node.first() + static_cast<std::uint32_t>(placement.references), node.count())
                         : KdNode::interior(static_cast<int>(node.axis()), node.plane(),
                                            node.lower_child() + static_cast<std::uint32_t>(placement.pairs) - 2);
    }
    std::copy(part.references.begin(), part.references.end(), tree.references.begin() + static_cast<std::ptrdiff_t>(placement.references));
  }

  std::vector<Placement> placements_;
  std::vector<Joint> joints_;
  std::size_t node_count_ = 2;
  std::size_t reference_count_ = 0;
};

}  // namespace

KdTree assemble(const KdTreePart& root, const Box& bounds) {
  KdTree tree = Assembly(root).copy();
  tree.bounds = bounds;
  tree.depth = root.depth;
  return tree;
}

}  // namespace grove
