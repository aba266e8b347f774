#include "grove/build/splits/object_median.h"

#include <algorithm>

#include "grove/build/splits/measure_sides.h"

namespace grove {

OrderedSplit ObjectMedianHeuristic::find(const ReferenceRange& range, std::span<const PrimitiveReference> references, Scratch& keys) const {
  OrderedSplit split;
  split.axis = range.centres.box().longest_axis();
  keys.resize(references.size());
  parallel_ranges(references.size(), kBuildChunkSize, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) keys[i] = centre_key(references[i], split.axis);
  });
  const auto middle = keys.begin() + static_cast<std::ptrdiff_t>(keys.size() / 2);
  std::nth_element(keys.begin(), middle, keys.end());
  split.first_right = *middle;
  measure_sides(split, references, context_, kBuildChunkSize);
  return split;
}

OrderedSplit ObjectMedianHeuristic::find_in_parallel(const ReferenceRange& range, std::span<const PrimitiveReference> references) const {
  Scratch keys;
  return find(range, references, keys);
}

}  // namespace grove
