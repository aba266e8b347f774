#pragma once

#include "grove/accel/kd_tree.h"
#include "grove/build/kd_tree/kd_cell.h"
#include "grove/build/kd_tree/kd_tree_part.h"
#include "grove/build/kd_tree/kd_tree_settings.h"
#include "grove/build/kd_tree/part_references.h"
#include "grove/build/kd_tree/reference_clipper.h"
#include "grove/build/primitive_reference.h"

namespace grove {

/// Builds a kd-tree from the root down, in parallel in the caller's oneTBB arena; the result is the same, bit for bit, for any number of threads. Depth,
/// time and the number of references are bounded for any input: sets that no plane parts become leaves, however large. O(n log n) with n the references.
/// Peak memory: some 250 bytes a reference with KdSplit::sah, 100 else. Throws InputError where the tree would have more than KdTree::kMaxNodes nodes.
[[nodiscard]] KdTree build_kd_tree(ReferenceList list, const ReferenceClipper& clipper, const KdTreeSettings& settings);

/// What all parts of one kd-tree share.
struct KdBuildContext {
  const ReferenceClipper& clipper;
  const KdTreeSettings& settings;
  float area_scale;          ///< AreaMeasure::scale of the whole tree
  std::uint32_t most_depth;  ///< of a leaf

  [[nodiscard]] KdCostContext costs() const { return {area_scale, settings.cost, settings.empty_bonus}; }
};

/// No leaf of a tree over so many primitives is deeper.
[[nodiscard]] std::uint32_t most_depth(const KdTreeSettings& settings, std::size_t primitive_count);

/// Builds a part of a tree below `cell`, whose capacity is at least the number of references. As build_kd_tree.
[[nodiscard]] KdTreePart build_kd_tree_part(References references, const KdCell& cell, const KdBuildContext& context);

/// The same over a geometry, which clips its primitives where `settings.clip` says so.
template <Geometry G>
[[nodiscard]] KdTree build_kd_tree(const G& geometry, const KdTreeSettings& settings) {
  if (settings.clip) return build_kd_tree(list_references(geometry), GeometryClipper<G>(geometry), settings);
  return build_kd_tree(list_references(geometry), NoClipper(), settings);
}

}  // namespace grove
