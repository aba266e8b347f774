#pragma once

// Rebuilding parts of a hierarchy whose primitives have moved. Which parts is decided by equation 2 of the review: a subtree is worth rebuilding when
// the steps that the expected rays save in it, its chance of being met times what an entry costs now more than when it was built, are more than the
// steps that rebuilding takes.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "grove/accel/bvh2.h"
#include "grove/build/passes/subtree_costs.h"
#include "grove/build/primitive_reference.h"
#include "grove/build/top_down.h"

namespace grove {

struct RebuildDecision {
  /// How many rays will be traced before the next chance to rebuild.
  double rays = 1e6;
  /// What rebuilding takes for each reference, in steps of a traversal. Measured: docs/bvh.md.
  double steps_per_reference = 12.0;
  /// Smaller subtrees are not rebuilt alone.
  std::uint32_t least_references = 256;
};

/// The roots of the subtrees whose rebuilding saves most: all disjoint, in depth-first order; none when nothing is worth it, node 0 alone when
/// all should be rebuilt. `built` holds the cost per entry of each node as it was built. O(nodes / least_references) mostly.
[[nodiscard]] std::vector<std::uint32_t> choose_rebuilds(const Bvh2& bvh, const SubtreeCosts& now, std::span<const float> built,
                                                         const RebuildDecision& decision);

/// The primitives below a node, each once, ascending.
[[nodiscard]] std::vector<std::uint32_t> primitives_below(const Bvh2& bvh, std::uint32_t node);

/// A hierarchy with some subtrees replaced.
struct SplicedHierarchy {
  Bvh2 bvh;                               ///< in depth-first order
  std::vector<std::uint32_t> old_number;  ///< of each node: what it was before, or kNewNode
  static constexpr std::uint32_t kNewNode = 0xffffffffU;
};

/// Copies `bvh` with replacements[k] in place of the subtree of node roots[k]; the roots as choose_rebuilds gives them, and not node 0. Where a
/// replacement would reach deeper than traversals allow, the old subtree stays. O(nodes + references).
[[nodiscard]] SplicedHierarchy splice(const Bvh2& bvh, std::span<const std::uint32_t> roots, std::span<const Bvh2> replacements);

/// Rebuilds the subtrees of `roots` top-down over whole primitives; `bounds_of(primitive)` tells where a primitive is now.
template <typename BoundsOf>
[[nodiscard]] SplicedHierarchy rebuild_subtrees(const Bvh2& bvh, std::span<const std::uint32_t> roots, const BoundsOf& bounds_of,
                                                const TopDownSettings& settings) {
  std::vector<Bvh2> replacements(roots.size());
  parallel_for(roots.size(), 1, [&](std::size_t k) {
    ReferenceList list;
    for (const std::uint32_t primitive : primitives_below(bvh, roots[k])) {
      const Box box = bounds_of(primitive);
      list.references.push_back(make_reference(box, primitive));
      list.bounds.grow(box);
    }
    replacements[k] = build_top_down(std::move(list), settings);
  });
  return splice(bvh, roots, replacements);
}

}  // namespace grove
