#pragma once

// The cheapest of a few planes: min-max binning (Shevtsov, Soupikov and Kapustin 2007, "Highly Parallel Fast KD-tree Construction for Interactive Ray
// Tracing of Dynamic Scenes"; Popov et al. 2006). References are counted in the bins where they begin and where they end; sums over the bins then tell what
// lies on the sides of each border. Bins divide the bounds of the references rather than the cell, so that the outermost borders cut off empty space.

#include "grove/build/kd_tree/reference_set.h"

namespace grove {

class BinnedPlanes : public ReferenceFinder {
 public:
  struct Scratch : PartScratch {};
  using ReferenceFinder::ReferenceFinder;

  /// O(references).
  [[nodiscard]] KdPlane find(const ReferenceSet& set, const Box4& cell, Scratch& scratch) const;
};

}  // namespace grove
