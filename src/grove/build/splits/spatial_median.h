#pragma once

// The spatial median: both halves of the node's box have equal volume; a reference goes to the half that holds its centre. The
// longest axis is tried first, then the others where all centres lie in one half. O(n) for a range of n.

#include "grove/build/split.h"

namespace grove {

/// References whose doubled centre on `axis` is below `doubled_plane` go left.
struct PlaneSplit : Split {
  int axis = 0;
  float doubled_plane = 0.0F;

  [[nodiscard]] Side side(const PrimitiveReference& reference) const {
    return reference.doubled_centre()[axis] < doubled_plane ? Side::left : Side::right;
  }
};

class SpatialMedianHeuristic {
 public:
  using Split = PlaneSplit;
  struct Scratch {};
  static constexpr bool kDividesReferences = false;

  explicit SpatialMedianHeuristic(const SplitContext& context) : context_(context) {}
  [[nodiscard]] const SplitContext& context() const { return context_; }

  [[nodiscard]] PlaneSplit find(const ReferenceRange& range, std::span<const PrimitiveReference> references, Scratch& scratch) const;
  [[nodiscard]] PlaneSplit find_in_parallel(const ReferenceRange& range, std::span<const PrimitiveReference> references) const;

 private:
  SplitContext context_;
};

}  // namespace grove
