#pragma once

#include <vector>

#include "grove/base/parallel.h"
#include "grove/build/split.h"

namespace grove {

/// Completes a split that tells sides but does not know yet what is on them: counts, boxes, cost, and whether it parts anything.
template <std::derived_from<Split> S>
void measure_sides(S& split, std::span<const PrimitiveReference> references, const SplitContext& context, std::size_t chunk_size) {
  struct Sides {
    Box4 box[2] = {Box4::empty(), Box4::empty()};
    std::uint32_t count[2] = {0, 0};
  };
  std::vector<Sides> chunks((references.size() + chunk_size - 1) / chunk_size);
  parallel_chunks(references.size(), chunk_size, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    Sides sides;
    for (std::size_t i = first; i < last; ++i) {
      const int side = split.side(references[i]) == Side::left ? 0 : 1;
      sides.box[side].grow(references[i].box());
      ++sides.count[side];
    }
    chunks[chunk] = sides;
  });
  for (const Sides& sides : chunks) {
    split.left.grow(sides.box[0]);
    split.right.grow(sides.box[1]);
    split.left_count += sides.count[0];
    split.right_count += sides.count[1];
  }
  split.is_possible = split.left_count > 0 && split.right_count > 0;
  if (!split.is_possible) return;
  split.cost = scaled_half_area(split.left, context.area_scale) * context.time(split.left_count) +
               scaled_half_area(split.right, context.area_scale) * context.time(split.right_count);
}

}  // namespace grove
