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
  for (int axis = 0; axis < 3; ++axis) {
    std::fill_n(box[axis], bin_count, Box4::empty());
    std::fill_n(count[axis], bin_count, 0U);
  }
}

void Bins::add(const BinMapping& mapping, std::span<const PrimitiveReference> references) {
  for (const PrimitiveReference& reference : references) {
    const Box4 bounds = reference.box();
    const Int4 bin = mapping.bins(bounds.lower + bounds.upper);
    box[0][bin[0]].grow(bounds);
    ++count[0][bin[0]];
    box[1][bin[1]].grow(bounds);
    ++count[1][bin[1]];
    box[2][bin[2]].grow(bounds);
    ++count[2][bin[2]];
  }
}

void Bins::merge(const Bins& other, int bin_count) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < bin_count; ++i) {
      box[axis][i].grow(other.box[axis][i]);
      count[axis][i] += other.count[axis][i];
    }
  }
}

BinnedSplit find_binned_split(const Bins& bins, const BinMapping& mapping, const SplitContext& context) {
  BinnedSplit best;
  best.mapping = mapping;
  best.cost = std::numeric_limits<float>::infinity();
  const int bin_count = mapping.bin_count;
  for (int axis = 0; axis < 3; ++axis) {
    if (!mapping.can_split(axis)) continue;
    float right_cost[kMaxBinCount];
    Box4 right = Box4::empty();
    std::uint32_t right_count = 0;
    for (int i = bin_count - 1; i > 0; --i) {
      right.grow(bins.box[axis][i]);
      right_count += bins.count[axis][i];
      right_cost[i] = right_count > 0 ? scaled_half_area(right, context.area_scale) * context.time(right_count) : 0.0F;
    }
    Box4 left = Box4::empty();
    std::uint32_t left_count = 0;
    const std::uint32_t total = right_count + bins.count[axis][0];
    for (int i = 1; i < bin_count; ++i) {
      left.grow(bins.box[axis][i - 1]);
      left_count += bins.count[axis][i - 1];
      if (left_count == 0 || left_count == total) continue;
      const float cost = scaled_half_area(left, context.area_scale) * context.time(left_count) + right_cost[i];
      if (cost < best.cost) {
        best.is_possible = true;
        best.axis = axis;
        best.bin = i;
        best.cost = cost;
        best.left = left;
        best.left_count = left_count;
        best.right_count = total - left_count;
      }
    }
  }
  if (best.is_possible)
    for (int i = best.bin; i < bin_count; ++i) best.right.grow(bins.box[best.axis][i]);
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
