#include "grove/build/splits/binned.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "grove/base/parallel.h"

namespace grove {
BinMapping::BinMapping(const Box4& doubled_centres, std::size_t reference_count) : offset(doubled_centres.lower) {
  bin_count = static_cast<int>(std::min<std::size_t>(kMaxBinCount, 4 + reference_count / 8));
  for (int axis = 0; axis < 3; ++axis) {
    const float extent = doubled_centres.upper[axis] - doubled_centres.lower[axis];
    // A shade below bin_count, so that the last centre falls into the last bin. Extents whose inverse overflows are left whole.
    const float s = static_cast<float>(bin_count) * (1.0F - 0x1p-20F) / extent;
    if (extent > 0.0F && s <= std::numeric_limits<float>::max()) scale[axis] = s;
  }
}

void Bins::clear(int bin_count) {
  for (auto& boxes : box) std::fill_n(boxes, bin_count, Box4::empty());
  std::fill_n(count, bin_count, Int4{});
}

void Bins::add(const BinMapping& mapping, std::span<const PrimitiveReference> references) {
  // A copy, which cannot change while bins are written.
  const BinMapping to_bins = mapping;
  for (const PrimitiveReference& reference : references) {
    const Box4 bounds = reference.box();
    const Int4 bin = to_bins.bins(bounds.lower + bounds.upper);
    for (int axis = 0; axis < 3; ++axis) {
      box[axis][bin[axis]].grow(bounds);
      ++reinterpret_cast<std::int32_t*>(count + bin[axis])[axis];
    }
  }
}

void Bins::merge(const Bins& other, int bin_count) {
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < bin_count; ++i) box[axis][i].grow(other.box[axis][i]);
  for (int i = 0; i < bin_count; ++i) count[i] += other.count[i];
}

namespace {

// The boxes of growing sets of bins along all three axes, and what they cost, one axis a lane.
class Sides {
 public:
  Sides(const Bins& bins, const SplitContext& context) : bins_(bins), context_(context) {}

  void grow(int bin) {
    for (int axis = 0; axis < 3; ++axis) boxes_[axis].grow(bins_.box[axis][bin]);
    counts_ += bins_.count[bin];
  }
  [[nodiscard]] Int4 counts() const { return counts_; }
  // Not a number where a set is empty.
  [[nodiscard]] Float4 cost() const {
    const Float4 scale = splat(context_.area_scale);
    Float4 extent[4] = {};
    for (int axis = 0; axis < 3; ++axis) extent[axis] = (boxes_[axis].upper - boxes_[axis].lower) * scale;
    transpose(extent);
    return (extent[0] * (extent[1] + extent[2]) + extent[1] * extent[2]) * context_.time(counts_);
  }

 private:
  const Bins& bins_;
  const SplitContext& context_;
  Box4 boxes_[3] = {Box4::empty(), Box4::empty(), Box4::empty()};
  Int4 counts_{};
};

}  // namespace

BinnedSplit find_binned_split(const Bins& bins, const BinMapping& mapping, const SplitContext& context) {
  const int bin_count = mapping.bin_count;
  Float4 right_cost[kMaxBinCount];
  Sides right(bins, context);
  for (int i = bin_count - 1; i > 0; --i) {
    right.grow(i);
    right_cost[i] = right.cost();
  }
  const Int4 total = right.counts() + bins.count[0];
  Float4 least = splat(std::numeric_limits<float>::infinity());
  Int4 border{};
  Sides left(bins, context);
  for (int i = 1; i < bin_count; ++i) {
    left.grow(i - 1);
    const Float4 cost = left.cost() + right_cost[i];
    // Costs of empty sides are not numbers, or infinite.
    const Int4 is_less = (cost < least) & (left.counts() != Int4{}) & (left.counts() != total);
    least = is_less ? cost : least;
    border = is_less ? Int4{i, i, i, i} : border;
  }
  BinnedSplit best;
  best.mapping = mapping;
  best.cost = std::numeric_limits<float>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (!mapping.can_split(axis) || !(least[axis] < best.cost)) continue;
    best.is_possible = true;
    best.axis = axis;
    best.bin = border[axis];
    best.cost = least[axis];
  }
  if (!best.is_possible) return best;
  for (int i = 0; i < best.bin; ++i) {
    best.left.grow(bins.box[best.axis][i]);
    best.left_count += static_cast<std::uint32_t>(bins.count[i][best.axis]);
  }
  for (int i = best.bin; i < bin_count; ++i) best.right.grow(bins.box[best.axis][i]);
  best.right_count = static_cast<std::uint32_t>(total[best.axis]) - best.left_count;
  return best;
}

BinnedSplit BinnedHeuristic::find(const ReferenceRange& range, std::span<const PrimitiveReference> references, Bins& bins) const {
  const BinMapping mapping(range.centres, range.count);
  bins.clear(mapping.bin_count);
  bins.add(mapping, references);
  return find_binned_split(bins, mapping, context_);
}

BinnedSplit BinnedHeuristic::find_in_parallel(const ReferenceRange& range, std::span<const PrimitiveReference> references) const {
  const BinMapping mapping(range.centres, range.count);
  std::vector<Bins> bins((references.size() + kBuildChunkSize - 1) / kBuildChunkSize);
  parallel_chunks(references.size(), kBuildChunkSize, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    bins[chunk].clear(mapping.bin_count);
    bins[chunk].add(mapping, references.subspan(first, last - first));
  });
  for (std::size_t chunk = 1; chunk < bins.size(); ++chunk) bins[0].merge(bins[chunk], mapping.bin_count);
  return find_binned_split(bins[0], mapping, context_);
}

}  // namespace grove
