#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "grove/registry/accelerator.h"

namespace grove {

/// A node of a structure with what rays did there.
struct ViewNode {
  static constexpr std::uint32_t kNone = 0xffffffffU;

  Box box;
  Vec3 planes{0.0F};             ///< as NodeView has them
  std::uint32_t parent = kNone;  ///< of the root kNone
  std::uint32_t depth = 0;       ///< edges from the root
  std::uint32_t child_count = 0;
  std::uint8_t cut_axes = 0;
  bool is_leaf = false;
  std::uint64_t references = 0;  ///< in the leaves at and below the node
  std::uint64_t visits = 0;      ///< times that rays stepped through the node, came to the leaf's cell or entered the leaf
  std::uint64_t tests = 0;       ///< of primitives, in the leaves at and below the node
};

/// All nodes of a structure, in depth-first order: parents come before their children. The references that a node of an octree has of its own are a leaf
/// below it.
class ViewTree {
 public:
  /// O(nodes); about 100 bytes a node.
  explicit ViewTree(const Accelerator& accelerator);

  [[nodiscard]] std::span<const ViewNode> nodes() const { return nodes_; }

  /// Where the node of a step stands; of a gap the node that it is an octant of. kNone for tests.
  [[nodiscard]] std::uint32_t find(const TraversalStep& step) const;

  /// Counts what a ray did, without what is below nodes. Not thread-safe.
  void count(std::span<const TraversalStep> steps);
  /// Adds what was counted in nodes to those above them; once, when all rays have been counted.
  void sum_up();

 private:
  std::vector<ViewNode> nodes_;
  // By NodeView::number.
  std::vector<std::uint32_t> interior_;
  std::vector<std::uint32_t> leaves_;
};

}  // namespace grove
