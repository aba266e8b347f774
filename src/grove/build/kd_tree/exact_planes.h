#pragma once

// The cheapest of all planes by exact events in O(n log n): Wald and Havran, "On building fast kd-trees for ray tracing, and on doing that in
// O(N log N)" (2006). The cost is piecewise linear along an axis and least where a reference begins or ends, so these planes suffice; events along each axis
// are sorted once and stay sorted. Differs from the paper in keeping a list for each axis, so that axes are independent, in numbering references anew in
// each set, and in doing large sets in parallel.

#include <array>

#include "grove/build/kd_tree/event_list.h"
#include "grove/build/kd_tree/part_references.h"

namespace grove {

struct EventSet {
  References references;
  std::array<KdEvents, 3> events;  ///< by axis
};

class ExactPlanes {
 public:
  using Set = EventSet;
  struct Scratch : PartScratch {
    EventScratch events;
  };

  ExactPlanes(const KdCostContext& costs, const ReferenceClipper& clipper) : costs_(costs), clipper_(clipper) {}
  [[nodiscard]] const KdCostContext& costs() const { return costs_; }

  [[nodiscard]] static Set make_set(References references);

  /// The lowest axis and position of those of equal cost. O(events).
  [[nodiscard]] KdPlane find(const Set& set, const Box4& cell, Scratch& scratch) const;

  void part(const Set& set, const KdPlane& plane, Set* const sides[2], Scratch& scratch) const;

 private:
  KdCostContext costs_;
  const ReferenceClipper& clipper_;
};

}  // namespace grove
