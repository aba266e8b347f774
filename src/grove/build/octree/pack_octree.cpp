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
  OctreeDraft::Place place;
  std::size_t at;
  std::uint32_t depth;
  Cursor cursor;
};

class Packing {
 public:
  Packing(const OctreeDraft& draft, const Octree* before, Octree& tree) : before_(before), tree_(tree) {
    const Cursor size = measure(draft);
    // The root is a node, even where there is nothing to cut.
    const auto [root_draft, root] = draft.resolve(draft.root);
    const std::size_t nodes = size.node + (root.kind() == Kind::leaf ? 1 : 0);
    constexpr std::size_t kMost = DraftSlot::kMostNumbers;
    if (nodes >= kMost || size.leaf >= kMost || size.reference > 0xfffffffeU)
      throw InputError(
          "the octree would have 2^29 nodes or leaves, or more than 2^32 - 2 references; split the geometry into instances, or lower "
          "max-depth");
    tree.nodes.resize(nodes);
    tree.leaf_first.resize(size.leaf + 1);
    tree.references.resize(size.reference);
    tree.leaf_first[size.leaf] = static_cast<std::uint32_t>(size.reference);
    if (root.kind() == Kind::leaf) {
      Cursor cursor;
      copy_leaf(*root_draft, root_draft->leaves[root.number()], cursor);
      const Vec3& planes = tree.cell.upper;
      tree.nodes[0] = {{planes.x, planes.y, planes.z}, 1, 0, 0, 0, 1, 0};
      return;
    }
    std::vector<Job> jobs;
    Cursor cursor;
    cursor.node = 1;
    tree.depth = copy({root_draft, root}, 0, 0, cursor, &jobs);
    std::vector<std::uint32_t> depths(jobs.size());
    parallel_for(jobs.size(), 1, [&](std::size_t i) {
      Job& job = jobs[i];
      depths[i] = copy(job.place, job.at, job.depth, job.cursor, nullptr);
    });
    for (const std::uint32_t depth : depths) tree.depth = std::max(tree.depth, depth);
  }

 private:
  [[nodiscard]] Cursor measure(const OctreeDraft& draft) const {
    Cursor size{draft.nodes.size(), draft.leaves.size(), draft.references.size()};
    const auto add = [&](const Cursor& more) { size = {size.node + more.node, size.leaf + more.leaf, size.reference + more.reference}; };
    if (draft.root.kind() == Kind::kept) add(measure_kept(draft.root.number()));
    for (const DraftNode& node : draft.nodes) {
      size.leaf += node.own.count > 0 ? 1 : 0;
      for (const DraftSlot octant : node.octants)
        if (octant.kind() == Kind::kept) add(measure_kept(octant.number()));
    }
    for (const auto& part : draft.parts) add(measure(*part));
    return size;
  }

  [[nodiscard]] Cursor measure_kept(std::uint32_t number) const {
    const Octree::Below below = before_->below(number);
    return {std::size_t{1} + below.end_node - below.first_node, below.end_leaf - below.first_leaf,
            before_->leaf_first[below.end_leaf] - before_->leaf_first[below.first_leaf]};
  }

  void copy_leaf(const OctreeDraft& draft, const DraftLeaf& leaf, Cursor& cursor) {
    tree_.leaf_first[cursor.leaf++] = static_cast<std::uint32_t>(cursor.reference);
    std::copy_n(draft.references.begin() + leaf.first, leaf.count,
                tree_.references.begin() + static_cast<std::ptrdiff_t>(cursor.reference));
    cursor.reference += leaf.count;
  }

  // Both return the depth of the deepest leaf. With `jobs`, what is below parts that have no parts themselves is left to them.
  std::uint32_t copy(const OctreeDraft::Place& place, std::size_t at, std::uint32_t depth, Cursor& cursor, std::vector<Job>* jobs) {
    return place.slot.kind() == Kind::kept ? copy_kept(place.slot.number(), at, depth, cursor)
                                           : copy_node(*place.draft, place.slot.number(), at, depth, cursor, jobs);
  }

  // What is below a node of the octree before is in a row; its numbers move.
  std::uint32_t copy_kept(std::uint32_t number, std::size_t at, std::uint32_t depth, Cursor& cursor) {
    const Octree::Below below = before_->below(number);
    const std::uint32_t first_reference = before_->leaf_first[below.first_leaf];
    const auto moved = [&](OctreeNode node) {
      node.first_child += static_cast<std::uint32_t>(cursor.node) - below.first_node;
      node.first_leaf += static_cast<std::uint32_t>(cursor.leaf) - below.first_leaf;
      return node;
    };
    tree_.nodes[at] = moved(before_->nodes[number]);
    for (std::uint32_t i = below.first_node; i < below.end_node; ++i)
      tree_.nodes[cursor.node + i - below.first_node] = moved(before_->nodes[i]);
    for (std::uint32_t i = below.first_leaf; i < below.end_leaf; ++i)
      tree_.leaf_first[cursor.leaf + i - below.first_leaf] =
          before_->leaf_first[i] - first_reference + static_cast<std::uint32_t>(cursor.reference);
    const Cursor size = measure_kept(number);
    std::copy_n(before_->references.begin() + first_reference, size.reference,
                tree_.references.begin() + static_cast<std::ptrdiff_t>(cursor.reference));
    cursor = {cursor.node + size.node - 1, cursor.leaf + size.leaf, cursor.reference + size.reference};
    return depth + depth_below(before_->nodes[number]);
  }

  [[nodiscard]] std::uint32_t depth_below(const OctreeNode& node) const {
    std::uint32_t deepest = node.leaf_mask != 0 ? 1 : 0;
    for (std::uint32_t i = 0; i < count_octants(node.interior_mask); ++i)
      deepest = std::max(deepest, 1 + depth_below(before_->nodes[node.first_child + i]));
    return deepest;
  }

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
      if (is_interior(child)) packed.interior_mask |= static_cast<std::uint8_t>(1U << octant);
      if (child.kind() != Kind::leaf) continue;
      packed.leaf_mask |= static_cast<std::uint8_t>(1U << octant);
      copy_leaf(*child_draft, child_draft->leaves[child.number()], cursor);
      deepest = depth + 1;
    }
    tree_.nodes[at] = packed;
    std::size_t child_at = cursor.node;
    cursor.node += count_octants(packed.interior_mask);
    for (const DraftSlot octant : node.octants) {
      const auto [child_draft, child] = draft.resolve(octant);
      if (!is_interior(child)) continue;
      const bool is_job = child.kind() == Kind::kept || (child_draft != &draft && child_draft->parts.empty());
      if (jobs != nullptr && is_job) {
        jobs->push_back({{child_draft, child}, child_at++, depth + 1, cursor});
        const Cursor size = child.kind() == Kind::kept ? measure_kept(child.number()) : measure(*child_draft);
        cursor = {cursor.node + size.node - 1, cursor.leaf + size.leaf, cursor.reference + size.reference};
      } else {
        deepest = std::max(deepest, copy({child_draft, child}, child_at++, depth + 1, cursor, jobs));
      }
    }
    return deepest;
  }

  static bool is_interior(DraftSlot slot) { return slot.kind() == Kind::node || slot.kind() == Kind::kept; }

  const Octree* before_;
  Octree& tree_;
};

}  // namespace

Octree pack_octree(const OctreeDraft& draft, const Box& bounds, const Box& cell, const Octree* before) {
  Octree tree;
  tree.bounds = bounds;
  tree.cell = cell;
  if (draft.root.kind() != Kind::empty) Packing(draft, before, tree);
  return tree;
}

}  // namespace grove
