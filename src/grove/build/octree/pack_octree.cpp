#include "grove/build/octree/pack_octree.h"

#include <algorithm>

#include "grove/base/error.h"
#include "grove/base/parallel.h"

namespace grove {
namespace {

using Kind = DraftSlot::Kind;

// Where the next of each kind goes.
struct Cursor {
  std::size_t node = 0;
  std::size_t leaf = 0;
  std::size_t reference = 0;
};

// A subtree that a task copies: its root to `at`, all below from `cursor` on.
struct Job {
  const OctreeDraft* draft;
  std::uint32_t node;
  std::size_t at;
  std::uint32_t depth;
  Cursor cursor;
};

class Packing {
 public:
  Packing(const OctreeDraft& draft, Octree& tree) : tree_(tree) {
    const Cursor size = measure(draft);
    // The root is a node, even where there is nothing to cut.
    const auto [root_draft, root] = draft.resolve(draft.root);
    const std::size_t nodes = size.node + (root.kind() == Kind::leaf ? 1 : 0);
    constexpr std::size_t kMost = std::size_t{1} << 30;
    if (nodes > kMost || size.leaf > kMost || size.reference > 0xfffffffeU)
      throw InputError("the octree would have more than 2^30 nodes or leaves; split the geometry into instances, or lower max-depth");
    tree.nodes.resize(nodes);
    tree.leaf_first.resize(size.leaf + 1);
    tree.references.resize(size.reference);
    tree.leaf_first[size.leaf] = static_cast<std::uint32_t>(size.reference);
    if (root.kind() == Kind::leaf) {
      Cursor cursor;
      copy_leaf(*root_draft, root_draft->leaves[root.number()], cursor);
      const Vec3& planes = tree.cell.upper;
      tree.nodes[0] = {{planes.x, planes.y, planes.z}, 0, 0, 0, 0, 1, 0};
      return;
    }
    std::vector<Job> jobs;
    Cursor cursor;
    cursor.node = 1;
    copy_node(*root_draft, root.number(), 0, 0, cursor, &jobs);
    std::vector<std::uint32_t> depths(jobs.size());
    parallel_for(jobs.size(), 1, [&](std::size_t i) {
      Job& job = jobs[i];
      depths[i] = copy_node(*job.draft, job.node, job.at, job.depth, job.cursor, nullptr);
    });
    for (const std::uint32_t depth : depths) tree.depth = std::max(tree.depth, depth);
  }

 private:
  static Cursor measure(const OctreeDraft& draft) {
    Cursor size{draft.nodes.size(), draft.leaves.size(), draft.references.size()};
    for (const DraftNode& node : draft.nodes) size.leaf += node.own.count > 0 ? 1 : 0;
    for (const auto& part : draft.parts) {
      const Cursor below = measure(*part);
      size = {size.node + below.node, size.leaf + below.leaf, size.reference + below.reference};
    }
    return size;
  }

  void copy_leaf(const OctreeDraft& draft, const DraftLeaf& leaf, Cursor& cursor) {
    tree_.leaf_first[cursor.leaf++] = static_cast<std::uint32_t>(cursor.reference);
    std::copy_n(draft.references.begin() + leaf.first, leaf.count,
                tree_.references.begin() + static_cast<std::ptrdiff_t>(cursor.reference));
    cursor.reference += leaf.count;
  }

  // Returns the depth of the deepest leaf. With `jobs`, leaves to them what is below parts that have no parts themselves.
  std::uint32_t copy_node(const OctreeDraft& draft, std::uint32_t number, std::size_t at, std::uint32_t depth, Cursor& cursor,
                          std::vector<Job>* jobs) {
    const DraftNode& node = draft.nodes[number];
    OctreeNode packed{{node.planes.x, node.planes.y, node.planes.z},
                      static_cast<std::uint32_t>(cursor.node),
                      static_cast<std::uint32_t>(cursor.leaf),
                      0,
                      0,
                      static_cast<std::uint8_t>(node.own.count > 0 ? 1 : 0),
                      node.cut_axes};
    std::uint32_t deepest = 0;
    if (node.own.count > 0) {
      copy_leaf(draft, node.own, cursor);
      deepest = depth;
    }
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
      const auto [child_draft, child] = draft.resolve(node.octants[octant]);
      if (child.kind() == Kind::node) packed.interior_mask |= static_cast<std::uint8_t>(1U << octant);
      if (child.kind() != Kind::leaf) continue;
      packed.leaf_mask |= static_cast<std::uint8_t>(1U << octant);
      copy_leaf(*child_draft, child_draft->leaves[child.number()], cursor);
      deepest = depth + 1;
    }
    tree_.nodes[at] = packed;
    tree_.depth = jobs != nullptr ? std::max(tree_.depth, deepest) : tree_.depth;
    std::size_t child_at = cursor.node;
    cursor.node += count_octants(packed.interior_mask);
    for (const DraftSlot octant : node.octants) {
      const auto [child_draft, child] = draft.resolve(octant);
      if (child.kind() != Kind::node) continue;
      if (jobs != nullptr && child_draft != &draft && child_draft->parts.empty()) {
        jobs->push_back({child_draft, child.number(), child_at++, depth + 1, cursor});
        const Cursor size = measure(*child_draft);
        cursor = {cursor.node + size.node - 1, cursor.leaf + size.leaf, cursor.reference + size.reference};
      } else {
        deepest = std::max(deepest, copy_node(*child_draft, child.number(), child_at++, depth + 1, cursor, jobs));
      }
    }
    return deepest;
  }

  Octree& tree_;
};

}  // namespace

Octree pack_octree(const OctreeDraft& draft, const Box& bounds, const Box& cell) {
  Octree tree;
  tree.bounds = bounds;
  tree.cell = cell;
  if (draft.root.kind() != Kind::empty) Packing(draft, tree);
  return tree;
}

}  // namespace grove
