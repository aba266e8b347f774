#pragma once

#include <concepts>
#include <cstddef>

#include "grove/geometry/hit.h"
#include "grove/geometry/ray.h"
#include "grove/geometry/traversal_counts.h"
#include "grove/math/box.h"

namespace grove {

/// The counter that counts nothing: all its functions compile to nothing.
struct NoCounter {
  void visit_node() {}
  void test_primitive() {}
  void enter_leaf() {}
  void reach_stack_depth(std::uint32_t /*depth*/) {}
  /// Where nested levels should count.
  [[nodiscard]] TraversalCounts* nested() { return nullptr; }
};

/// The counter that counts.
class Counter {
 public:
  explicit Counter(TraversalCounts& counts) : counts_(counts) {}
  void visit_node() { ++counts_.nodes_visited; }
  void test_primitive() { ++counts_.primitives_tested; }
  void enter_leaf() { ++counts_.leaves_entered; }
  void reach_stack_depth(std::uint32_t depth) {
    if (depth > counts_.stack_depth) counts_.stack_depth = depth;
  }
  [[nodiscard]] TraversalCounts* nested() { return &counts_; }

 private:
  TraversalCounts& counts_;
};

/// What every structure can be built over and every traversal can test: see TriangleMesh for the contract of each function.
template <typename G>
concept Geometry = requires(const G& geometry, std::size_t i, const Box& box, const Ray& ray, const typename G::PreparedRay& prepared,
                            Hit& hit, NoCounter& counter) {
  { geometry.size() } -> std::convertible_to<std::size_t>;
  { geometry.bounds(i) } -> std::same_as<Box>;
  { geometry.clip(i, box) } -> std::same_as<Box>;
  { geometry.overlaps(i, box) } -> std::same_as<bool>;
  { geometry.prepare(ray) } -> std::convertible_to<typename G::PreparedRay>;
  { geometry.intersect(i, prepared, hit, counter) } -> std::same_as<bool>;
  { geometry.occluded(i, prepared, counter) } -> std::same_as<bool>;
  geometry.locate(hit);
};

}  // namespace grove
