#pragma once

// The surface-area cost model (Goldsmith and Salmon 1987; MacDonald and Booth 1990): a ray that meets a convex body meets a convex body
// inside it with the ratio of their areas as probability.

#include <cstdint>

#include "grove/math/bounding_volume.h"
#include "grove/math/box.h"

namespace grove {

struct Bvh2;
struct KdTree;
struct Octree;
template <typename Node, typename Block>
class BasicFastBvh;
template <int kWidth>
struct WideBvh;
template <BoundingVolume V>
struct VolumeBvh;

/// How the cost of a split counts what lies inside its subsets (SubsetTime in build/split.h).
enum class SplitCost : std::uint8_t { standard, equation_2 };

/// Relative times of the steps of a traversal. Only their ratio matters to a builder. The defaults are measured for triangles: at 0.35 hierarchies
/// trace faster than at 0.5, 0.8 or 1, and have fewer nodes (docs/performance.md).
struct CostModel {
  double traversal = 1.0;      ///< stepping through one interior node (both children's boxes)
  double intersection = 0.35;  ///< testing one primitive
  SplitCost split_cost = SplitCost::standard;
  /// So many primitives are tested at once, a power of two: any number of them takes the time of the next multiple.
  std::uint32_t block_size = 1;

  /// `count` with the unused places of the last block.
  [[nodiscard]] std::uint32_t in_whole_blocks(std::uint32_t count) const { return (count + block_size - 1) & ~(block_size - 1); }
};

/// Half the surface area after dividing all lengths by the largest side of a whole scene, so that neither huge nor tiny coordinates
/// overflow or vanish.
class AreaMeasure {
 public:
  explicit AreaMeasure(const Box& scene);
  [[nodiscard]] float scale() const { return scale_; }
  [[nodiscard]] double half_area(const Box& box) const;

 private:
  float scale_ = 1.0F;
};

/// Expected time of tracing one ray that meets the root: the sum over interior nodes of traversal * area / root area, and over leaves of
/// intersection * references * area / root area. 0 for an empty hierarchy. O(nodes).
[[nodiscard]] double expected_cost(const Bvh2& bvh, const CostModel& model);

/// The same for a wide hierarchy; `model.traversal` is then the time of a step through a wide node.
template <int kWidth>
[[nodiscard]] double expected_cost(const WideBvh<kWidth>& bvh, const CostModel& model);

/// The same for the hierarchies of the fast path.
template <typename Node, typename Block>
[[nodiscard]] double expected_cost(const BasicFastBvh<Node, Block>& bvh, const CostModel& model);
/// The same for a kd-tree, whose cells take the place of boxes.
[[nodiscard]] double expected_cost(const KdTree& tree, const CostModel& model);
/// The same for an octree, whose cells count as far as they lie in the bounds of the primitives.
[[nodiscard]] double expected_cost(const Octree& tree, const CostModel& model);

/// The same by the areas of the hierarchy's own volumes, for a ray that meets the volume of the root.
template <BoundingVolume V>
[[nodiscard]] double expected_cost(const VolumeBvh<V>& bvh, const CostModel& model);

}  // namespace grove
