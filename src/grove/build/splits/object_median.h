#pragma once

// The object median (Kay and Kajiya 1986): half of the references to each side, in the order of their centres along the axis on which these
// spread most. O(n) for a range of n.

#include <vector>

#include "grove/build/splits/centre_order.h"

namespace grove {

class ObjectMedianHeuristic {
 public:
  using Split = OrderedSplit;
  using Scratch = std::vector<std::uint64_t>;
  static constexpr bool kDividesReferences = false;

  explicit ObjectMedianHeuristic(const SplitContext& context) : context_(context) {}
  [[nodiscard]] const SplitContext& context() const { return context_; }

  [[nodiscard]] OrderedSplit find(const ReferenceRange& range, std::span<const PrimitiveReference> references, Scratch& keys) const;
  [[nodiscard]] OrderedSplit find_in_parallel(const ReferenceRange& range, std::span<const PrimitiveReference> references) const;

 private:
  SplitContext context_;
};

}  // namespace grove
