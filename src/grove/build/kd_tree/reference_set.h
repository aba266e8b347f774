#pragma once

#include <utility>

#include "grove/build/kd_tree/part_references.h"

namespace grove {

/// The set of finders that need no more than the references.
struct ReferenceSet {
  References references;
};

/// What those finders share: parting.
class ReferenceFinder {
 public:
  using Set = ReferenceSet;

  ReferenceFinder(const KdCostContext& costs, const ReferenceClipper& clipper) : costs_(costs), clipper_(clipper) {}
  [[nodiscard]] const KdCostContext& costs() const { return costs_; }

  [[nodiscard]] const ReferenceClipper& clipper() const { return clipper_; }

  [[nodiscard]] static Set make_set(References references) { return {std::move(references)}; }
  void part(const Set& set, const KdPlane& plane, Set* const sides[2], PartScratch& scratch) const {
    References* const references[2] = {&sides[0]->references, &sides[1]->references};
    part_references(set.references, plane, clipper_, references, TrackPlaces::no, scratch);
  }

 private:
  KdCostContext costs_;
  const ReferenceClipper& clipper_;
};

}  // namespace grove
