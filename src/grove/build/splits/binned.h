#pragma once

// The binned surface-area split: Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies" (2007). References are sorted
// into bins by their centres along all three axes in one pass; then every border between two bins is a candidate plane.

#include <cstdint>
#include <span>

#include "grove/build/split.h"

namespace grove {

inline constexpr int kMaxBinCount = 16;

/// Which bin a centre falls into, per axis. Made for one set of references from the bounds of their doubled centres.
struct BinMapping {
  Float4 offset{};
  Float4 scale{};
  int bin_count = kMaxBinCount;

  BinMapping() = default;
  /// Bins in proportion to the references, up to kMaxBinCount: many bins for few references cost more than they find.
  BinMapping(const Box4& doubled_centres, std::size_t reference_count);

  /// Lanes 0 to 2: the bin on each axis, in [0, bin_count).
  [[nodiscard]] Int4 bins(Float4 doubled_centre) const {
    const Float4 position = (doubled_centre - offset) * scale;
    return __builtin_convertvector(position, Int4);
  }
  /// Whether centres differ on this axis.
  [[nodiscard]] bool can_split(int axis) const { return scale[axis] > 0.0F; }
};

/// Bounds and counts of the bins along all three axes.
struct Bins {
  Box4 box[3][kMaxBinCount];
  Int4 count[kMaxBinCount];  // an axis a lane

  void clear(int bin_count);
  void add(const BinMapping& mapping, std::span<const PrimitiveReference> references);
  void merge(const Bins& other, int bin_count);
};

/// The cheapest border: references with bin < `bin` on `axis` go left.
struct BinnedSplit : Split {
  BinMapping mapping;
  int axis = 0;
  int bin = 0;

  [[nodiscard]] Side side(const PrimitiveReference& reference) const {
    return mapping.bins(reference.doubled_centre())[axis] < bin ? Side::left : Side::right;
  }
};

/// Sweeps the bins of each axis from both sides; ties go to the lower axis, then the lower border. O(bins).
[[nodiscard]] BinnedSplit find_binned_split(const Bins& bins, const BinMapping& mapping, const SplitContext& context);

class BinnedHeuristic {
 public:
  using Split = BinnedSplit;
  using Scratch = Bins;
  static constexpr bool kDividesReferences = false;

  explicit BinnedHeuristic(const SplitContext& context) : context_(context) {}
  [[nodiscard]] const SplitContext& context() const { return context_; }

  [[nodiscard]] BinnedSplit find(const ReferenceRange& range, std::span<const PrimitiveReference> references, Bins& bins) const;
  [[nodiscard]] BinnedSplit find_in_parallel(const ReferenceRange& range, std::span<const PrimitiveReference> references) const;

 private:
  SplitContext context_;
};

}  // namespace grove
