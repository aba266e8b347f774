#include "grove/build/bottom_up/cluster_tree.h"

#include <algorithm>
#include <utility>

#include "grove/base/parallel.h"
#include "grove/build/hierarchy_part.h"

namespace grove {

ClusterTree::ClusterTree(HugeVector<PrimitiveReference> references, const SubtreeCost& subtree_cost)
    : subtree_cost_(subtree_cost), references_(std::move(references)), pairs_(references_.size() - 1) {}

Cluster ClusterTree::join(std::uint32_t join, const Cluster& left, const Cluster& right) {
  const Size a = size(left.primitive());
  const Size b = size(right.primitive());
  Box4 box = left.box();
  box.grow(right.box());
  const std::uint32_t count = a.references + b.references;
  const SubtreeCost::Decision decision = subtree_cost_.of_pair(box, count, left.upper[3] + right.upper[3]);
  pairs_[join] = {left.primitive(), right.primitive(), {count, decision.is_leaf ? 0 : 1 + a.nodes + b.nodes}};
  return make_cluster(box, static_cast<std::uint32_t>(references_.size()) + join, decision.cost);
}

Bvh2 ClusterTree::hierarchy(const Box& bounds) const {
  Bvh2 bvh;
  bvh.bounds = bounds;
  bvh.references.resize(references_.size());
  const auto root = static_cast<std::uint32_t>(references_.size() + pairs_.size() - 1);
  bvh.nodes.resize(size(root).nodes);
  bvh.depth = write(root, {0, 0}, bvh).height;
  return bvh;
}

// Writes a cluster whose first reference and node have the numbers in `place`.
ClusterTree::Written ClusterTree::write(std::uint32_t cluster, Size place, Bvh2& bvh) const {
  constexpr std::uint32_t kTaskSize = 8192;
  if (size(cluster).nodes == 0) return {write_leaf(cluster, bvh.references.data() + place.references), 0};
  const std::uint32_t children[2] = {pair(cluster).left, pair(cluster).right};
  const Size sizes[2] = {size(children[0]), size(children[1])};
  const Size places[2] = {{place.references, place.nodes + 1}, {place.references + sizes[0].references, place.nodes + 1 + sizes[0].nodes}};
  Written written[2];
  if (sizes[0].references + sizes[1].references > kTaskSize) {
    parallel_invoke([&] { written[0] = write(children[0], places[0], bvh); }, [&] { written[1] = write(children[1], places[1], bvh); });
  } else {
    for (int i = 0; i < 2; ++i) written[i] = write(children[i], places[i], bvh);
  }
  Bvh2Node& node = bvh.nodes[place.nodes];
  set_children(node, written[0].box, written[1].box);
  for (int i = 0; i < 2; ++i) {
    const bool is_leaf = sizes[i].nodes == 0;
    node.child[i] = {is_leaf ? places[i].references : places[i].nodes, is_leaf ? sizes[i].references : 0};
  }
  Box4 box = written[0].box;
  box.grow(written[1].box);
  return {box, 1 + std::max(written[0].height, written[1].height)};
}

Box4 ClusterTree::write_leaf(std::uint32_t cluster, std::uint32_t* references) const {
  if (is_single(cluster)) {
    *references = references_[cluster].primitive();
    return references_[cluster].box();
  }
  Box4 box = write_leaf(pair(cluster).left, references);
  box.grow(write_leaf(pair(cluster).right, references + size(pair(cluster).left).references));
  return box;
}

}  // namespace grove
