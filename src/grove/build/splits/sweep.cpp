#include "grove/build/splits/sweep.h"

#include <algorithm>
#include <limits>

#include "grove/base/parallel.h"

namespace grove {

OrderedSplit SweepHeuristic::best_on_axis(int axis, std::span<const PrimitiveReference> references, Scratch& scratch) const {
  const std::size_t count = references.size();
  scratch.items.resize(count);
  scratch.right_cost.resize(count);
  parallel_ranges(count, kBuildChunkSize, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) scratch.items[i] = {centre_key(references[i], axis), static_cast<std::uint32_t>(i)};
  });
  parallel_sort(scratch.items, [](const Item& a, const Item& b) { return a.key < b.key; });

  Box4 right = Box4::empty();
  for (std::size_t i = count - 1; i > 0; --i) {
    right.grow(references[scratch.items[i].index].box());
    scratch.right_cost[i] = scaled_half_area(right, context_.area_scale) * context_.time(static_cast<std::uint32_t>(count - i));
  }
  OrderedSplit best;
  best.axis = axis;
  best.cost = std::numeric_limits<float>::infinity();
  Box4 left = Box4::empty();
  for (std::size_t i = 1; i < count; ++i) {
    left.grow(references[scratch.items[i - 1].index].box());
    const float cost = scaled_half_area(left, context_.area_scale) * context_.time(static_cast<std::uint32_t>(i)) + scratch.right_cost[i];
    if (cost < best.cost) {
      best.is_possible = true;
      best.cost = cost;
      best.first_right = scratch.items[i].key;
      best.left = left;
      best.left_count = static_cast<std::uint32_t>(i);
    }
  }
  best.right_count = static_cast<std::uint32_t>(count) - best.left_count;
  for (std::size_t i = best.left_count; i < count; ++i) best.right.grow(references[scratch.items[i].index].box());
  return best;
}

OrderedSplit SweepHeuristic::find(const ReferenceRange& range, std::span<const PrimitiveReference> references, Scratch& scratch) const {
  OrderedSplit best;
  for (int axis = 0; axis < 3; ++axis) {
    // Where all centres agree, any order is as good as another: the driver halves.
    if (!(range.centres.lower[axis] < range.centres.upper[axis])) continue;
    const OrderedSplit split = best_on_axis(axis, references, scratch);
    if (split.is_possible && (!best.is_possible || split.cost < best.cost)) best = split;
  }
  return best;
}

OrderedSplit SweepHeuristic::find_in_parallel(const ReferenceRange& range, std::span<const PrimitiveReference> references) const {
  OrderedSplit splits[3];
  parallel_for(3, 1, [&](std::size_t i) {
    const int axis = static_cast<int>(i);
    Scratch scratch;
    if (range.centres.lower[axis] < range.centres.upper[axis]) splits[i] = best_on_axis(axis, references, scratch);
  });
  OrderedSplit best;
  for (const OrderedSplit& split : splits)
    if (split.is_possible && (!best.is_possible || split.cost < best.cost)) best = split;
  return best;
}

}  // namespace grove
