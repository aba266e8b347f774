#pragma once

// The cheapest of a few planes: min-max binning (Shevtsov, Soupikov and Kapustin 2007, "Highly Parallel Fast KD-tree Construction for Interactive Ray
// Tracing of Dynamic Scenes"; Popov et al. 2006). References are counted in the bins where they begin and where they end; sums over the bins then tell what
// lies on the sides of each border. Bins divide the bounds of the references rather than the cell, so that the outermost borders cut off empty space.
// Small sets are left to exact planes, as in the first paper: a border of bins cuts primitives that a plane through their ends would spare, which made 4.8
// references a triangle of a terrain where now there are 1.1.

#include "grove/build/kd_tree/exact_planes.h"
#include "grove/build/kd_tree/reference_set.h"

namespace grove {

class BinnedPlanes : public ReferenceFinder {
 public:
  struct Scratch : PartScratch {};
  using ReferenceFinder::ReferenceFinder;

  [[nodiscard]] ExactPlanes for_small_sets() const { return {costs(), clipper()}; }

  /// O(references).
  [[nodiscard]] KdPlane find(const ReferenceSet& set, const Box4& cell, Scratch& scratch) const;
};

}  // namespace grove
