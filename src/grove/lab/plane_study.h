#pragma once

// Where the cheapest plane of a set lies (MacDonald and Booth 1990 say between the spatial and the object median), and on which side it leaves the crowd: asked at every node
// of a tree that is parted at the cheapest plane, down to sets of a few.

#include <cstdint>
#include <vector>

#include "grove/build/primitive_reference.h"

namespace grove {

/// What is parted: the primitives, by their centres, as in a hierarchy, or the cell, as in a kd-tree, by equation 9 of the review.
enum class PartedBy : std::uint8_t { objects, space };

/// Over nodes of one level, or all.
struct PlaneTally {
  std::uint64_t nodes = 0;
  std::uint64_t axes = 0;              ///< of these nodes that can be parted: up to three each
  std::uint64_t between_on_axis = 0;   ///< axes whose cheapest plane lies between their medians
  std::uint64_t between = 0;           ///< nodes of whose cheapest plane on any axis that is true
  std::uint64_t uneven = 0;            ///< nodes whose cheapest plane leaves more on one side than on the other
  std::uint64_t crowd_is_smaller = 0;  ///< of these, those where the side with more has the smaller area
  std::uint64_t crowd_is_denser = 0;   ///< those where it has more objects for its area
  double cost_between = 0.0;           ///< sum over nodes: cheapest cost between the medians / cheapest cost
  double cost_candidates = 0.0;        ///< the same for eight planes equally spaced from one median to the other
  double cost_spatial = 0.0;           ///< the same for the spatial median
  double cost_object = 0.0;            ///< the same for the object median

  void add(const PlaneTally& other);
};

struct PlaneStudy {
  std::vector<PlaneTally> levels;
  PlaneTally all;
};

/// Parts sets of more than `smallest` down to `levels` levels. One thread, O(n log n) a level.
[[nodiscard]] PlaneStudy study_planes(const ReferenceList& list, PartedBy parted_by, unsigned levels, std::size_t smallest = 8);

}  // namespace grove
