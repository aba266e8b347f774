#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "grove/base/huge_vector.h"
#include "grove/base/parallel.h"
#include "grove/geometry/geometry_concept.h"
#include "grove/math/float4.h"

namespace grove {

/// A primitive as a builder moves it about: its bounds, and its id in the free lane. 32 bytes.
struct PrimitiveReference {
  Float4 lower;  ///< lane 3: the bits of the primitive id
  Float4 upper;

  [[nodiscard]] std::uint32_t primitive() const { return last_lane_bits(lower); }
  [[nodiscard]] Box4 box() const { return {without_last_lane(lower), upper}; }
  /// Twice the centre of the box.
  [[nodiscard]] Float4 doubled_centre() const {
    const Box4 bounds = box();
    return bounds.lower + bounds.upper;
  }
};

static_assert(sizeof(PrimitiveReference) == 32);

[[nodiscard]] inline PrimitiveReference make_reference(const Box& box, std::uint32_t primitive) {
  return {Float4{box.lower.x, box.lower.y, box.lower.z, std::bit_cast<float>(primitive)},
          Float4{box.upper.x, box.upper.y, box.upper.z, 0.0F}};
}

/// References of a geometry, in order of id, without the primitives that can never be hit.
struct ReferenceList {
  HugeVector<PrimitiveReference> references;
  Box bounds;
};

/// Lists the references of a geometry in parallel; the same for any number of threads. O(n).
template <Geometry G>
[[nodiscard]] ReferenceList list_references(const G& geometry) {
  constexpr std::size_t kChunk = 16384;
  const std::size_t size = geometry.size();
  std::vector<std::size_t> chunk_first((size + kChunk - 1) / kChunk + 1, 0);
  std::vector<Box> chunk_bounds(chunk_first.size());
  ReferenceList list;
  list.references.resize(size);
  parallel_chunks(size, kChunk, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    std::size_t kept = first;
    for (std::size_t i = first; i < last; ++i) {
      const Box box = geometry.bounds(i);
      if (box.is_empty()) continue;
      list.references[kept++] = make_reference(box, static_cast<std::uint32_t>(i));
      chunk_bounds[chunk].grow(box);
    }
    chunk_first[chunk + 1] = kept - first;
  });
  // Close the gaps that dropped primitives left; usually there are none and nothing moves.
  std::size_t end = 0;
  for (std::size_t chunk = 0; chunk + 1 < chunk_first.size(); ++chunk) {
    const std::size_t count = chunk_first[chunk + 1];
    if (end != chunk * kChunk)
      std::copy_n(list.references.begin() + static_cast<std::ptrdiff_t>(chunk * kChunk), count,
                  list.references.begin() + static_cast<std::ptrdiff_t>(end));
    end += count;
    list.bounds.grow(chunk_bounds[chunk]);
  }
  list.references.resize(end);
  return list;
}

}  // namespace grove
