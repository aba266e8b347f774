#pragma once

// What one ray does in a structure, step by step, for those who want to look at it. Walks tell their counter of each step by the functions below; counters
// that only count never learn which node it was, so for them the numbers compile to nothing.

#include <cstdint>
#include <vector>

#include "grove/geometry/hit.h"
#include "grove/geometry/traversal_counts.h"

namespace grove {

/// One step of a walk.
struct TraversalStep {
  enum class Kind : std::uint8_t {
    node,  ///< an interior node is stepped through
    cell,  ///< a leaf's cell is come to on the way from neighbour to neighbour
    gap,   ///< so is an octant of an interior node in which there is nothing
    leaf,  ///< a leaf is entered
    test,  ///< a primitive is tested
  };

  Kind kind;
  std::uint8_t octant = 0;   ///< of a gap
  std::uint32_t number = 0;  ///< NodeView::number of the node or leaf, or the primitive's over the whole geometry
  float closest = 0.0F;      ///< distance of the closest hit before this step; the ray's t_max where there is none
};

/// All steps of a walk in order. `node`, `cell` and `gap` steps are what TraversalCounts counts as nodes, `leaf` and `test` steps its leaves and tests.
struct TraversalRecord {
  std::vector<TraversalStep> steps;
  /// What was done below the primitives (objects of instances), whose steps are not told.
  TraversalCounts nested;
};

/// The counter that records. `hit` is what the walk lowers, and must outlive it.
class Recorder {
 public:
  Recorder(TraversalRecord& record, const Hit& hit) : record_(record), hit_(hit) {}

  void visit_node(std::uint32_t number) { add(TraversalStep::Kind::node, 0, number); }
  void visit_cell(std::uint32_t number) { add(TraversalStep::Kind::cell, 0, number); }
  void visit_gap(std::uint32_t number, std::uint32_t octant) { add(TraversalStep::Kind::gap, static_cast<std::uint8_t>(octant), number); }
  void enter_leaf(std::uint32_t number) { add(TraversalStep::Kind::leaf, 0, number); }
  void test_primitive(std::uint32_t number) { add(TraversalStep::Kind::test, 0, number); }
  void reach_stack_depth(std::uint32_t depth) {
    if (depth > record_.nested.stack_depth) record_.nested.stack_depth = depth;
  }
  [[nodiscard]] TraversalCounts* nested() { return &record_.nested; }

 private:
  void add(TraversalStep::Kind kind, std::uint8_t octant, std::uint32_t number) { record_.steps.push_back({kind, octant, number, hit_.t}); }

  TraversalRecord& record_;
  const Hit& hit_;
};

/// A counter that wants to know which node, leaf or primitive it is.
template <typename C>
concept TellsApart = requires(C& counter, std::uint32_t number) {
  counter.visit_node(number);
};

/// Tells a counter that interior node `number` is stepped through.
template <typename C>
void count_node(C& counter, std::uint32_t number) {
  if constexpr (TellsApart<C>) {
    counter.visit_node(number);
  } else {
    counter.visit_node();
  }
}

/// That the cell of leaf `number` is come to by a walk from neighbour to neighbour.
template <typename C>
void count_cell(C& counter, std::uint32_t number) {
  if constexpr (TellsApart<C>) {
    counter.visit_cell(number);
  } else {
    counter.visit_node();
  }
}

/// That an empty octant of node `number` is.
template <typename C>
void count_gap(C& counter, std::uint32_t number, std::uint32_t octant) {
  if constexpr (TellsApart<C>) {
    counter.visit_gap(number, octant);
  } else {
    counter.visit_node();
  }
}

/// That leaf `number` is entered.
template <typename C>
void count_leaf(C& counter, std::uint32_t number) {
  if constexpr (TellsApart<C>) {
    counter.enter_leaf(number);
  } else {
    counter.enter_leaf();
  }
}

/// That primitive `number` is tested.
template <typename C>
void count_test(C& counter, std::uint32_t number) {
  if constexpr (TellsApart<C>) {
    counter.test_primitive(number);
  } else {
    counter.test_primitive();
  }
}

}  // namespace grove
