#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "grove/lab/view/scene_walks.h"
#include "grove/render/scene_accelerator.h"
#include "grove/scene/scene.h"

namespace grove {

/// A node of a structure with what rays did there.
struct ViewNode {
  static constexpr std::uint32_t kNone = 0xffffffffU;

  Box box;                       ///< in world space
  Vec3 planes{0.0F};             ///< as NodeView has them
  std::uint32_t parent = kNone;  ///< of the root kNone
  std::uint32_t depth = 0;       ///< edges from the root
  std::uint32_t child_count = 0;
  std::uint8_t cut_axes = 0;  ///< as NodeView has them; 0 in objects that do not stand untransformed
  bool is_leaf = false;
  std::uint64_t references = 0;  ///< in the leaves at and below the node
  std::uint64_t visits = 0;      ///< times that rays stepped through the node, came to the leaf's cell or entered the leaf
  std::uint64_t tests = 0;       ///< of primitives, in the leaves at and below the node
};

/// All nodes of the structures over a scene, in depth-first order: parents come before their children. The references that a node of an octree has of its
/// own are a leaf below it. Where there is a top level, the structures of the instances' objects hang below its root, beside its own nodes.
class ViewTree {
 public:
  /// The structures of objects are there where that makes at most this many nodes: one and the same may stand in many places.
  static constexpr std::size_t kMostNestedNodes = 4'000'000;

  /// O(nodes); about 100 bytes a node.
  ViewTree(const Scene& scene, const SceneAccelerator& accelerator, std::size_t most_nested_nodes = kMostNestedNodes);

  [[nodiscard]] std::span<const ViewNode> nodes() const { return nodes_; }
  /// Whether the structures of objects are there, or there is no top level.
  [[nodiscard]] bool is_whole() const { return is_whole_; }

  /// Where the node of a step stands; of a gap the node that it is an octant of. kNone for tests, and for what is not there.
  [[nodiscard]] std::uint32_t find(const SceneStep& step) const;

  /// Counts what a ray did, without what is below nodes. Not thread-safe.
  void count(std::span<const SceneStep> steps);
  /// Adds what was counted in nodes to those above them; once, when all rays have been counted.
  void sum_up();

 private:
  // Where the nodes of one structure stand, by NodeView::number, from its root on.
  struct Places {
    std::vector<std::uint32_t> interior;
    std::vector<std::uint32_t> leaves;
  };

  // Appends the nodes of a structure, its root below `parent`; `transform` puts them in their places.
  void add(const Accelerator& accelerator, const Transform& transform, std::uint32_t parent, Places* places);

  std::vector<ViewNode> nodes_;
  Places top_;
  std::vector<Places> objects_;
  struct NestedTree {
    std::uint32_t object;
    std::uint32_t root;  // in nodes_
  };
  std::vector<NestedTree> instances_;
  bool is_whole_ = true;
};

}  // namespace grove
