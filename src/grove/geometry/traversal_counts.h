#pragma once

#include <cstdint>

namespace grove {

/// What one query did. Counted only when asked for.
struct TraversalCounts {
  std::uint64_t nodes_visited = 0;      ///< interior nodes stepped through (all their children's volumes tested), or cells entered
  std::uint64_t primitives_tested = 0;  ///< ray-primitive tests; an instance counts as one test at the top level
  std::uint64_t leaves_entered = 0;
  std::uint32_t stack_depth = 0;  ///< deepest stack of pending nodes; the maximum, not the sum, over nested levels

  TraversalCounts& operator+=(const TraversalCounts& other) {
    nodes_visited += other.nodes_visited;
    primitives_tested += other.primitives_tested;
    leaves_entered += other.leaves_entered;
    stack_depth = stack_depth > other.stack_depth ? stack_depth : other.stack_depth;
    return *this;
  }

  friend bool operator==(const TraversalCounts&, const TraversalCounts&) = default;
};

}  // namespace grove
