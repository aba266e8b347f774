#pragma once

// The exact surface-area heuristic over object splits: references are sorted by their centres along each axis, and each place of
// the three orders is a candidate (Wald, Boulos, Shirley, "Ray Tracing Deformable Scenes using Dynamic Bounding Volume
// Hierarchies", 2007, section 3). O(n log n) for a range of n.

#include <vector>

#include "grove/build/splits/centre_order.h"

namespace grove {

class SweepHeuristic {
 public:
  using Split = OrderedSplit;
  struct Item {
    std::uint64_t key;
    std::uint32_t index;
  };
  struct Scratch {
    std::vector<Item> items;
    std::vector<float> right_cost;
  };
  static constexpr bool kDividesReferences = false;

  explicit SweepHeuristic(const SplitContext& context) : context_(context) {}
  [[nodiscard]] const SplitContext& context() const { return context_; }

  [[nodiscard]] OrderedSplit find(const ReferenceRange& range, std::span<const PrimitiveReference> references, Scratch& scratch) const;
  [[nodiscard]] OrderedSplit find_in_parallel(const ReferenceRange& range, std::span<const PrimitiveReference> references) const;

 private:
  [[nodiscard]] OrderedSplit best_on_axis(int axis, std::span<const PrimitiveReference> references, Scratch& scratch) const;

  SplitContext context_;
};

}  // namespace grove
