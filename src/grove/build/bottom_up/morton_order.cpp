#include "grove/build/bottom_up/morton_order.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "grove/base/parallel.h"
#include "grove/build/reference_range.h"
#include "grove/math/morton.h"

namespace grove {
namespace {

constexpr std::size_t kGrain = 16384;
// Per axis. Coarse codes take three passes of sorting, fine ones six.
constexpr int kCoarseBits = 12;
constexpr int kFineBits = 21;

// Codes of centres in a grid of 2^bits cells a side over a cube around all of them.
class Grid {
 public:
  Grid(const Box4& centres, int bits) : lower_(centres.lower), most_((1 << bits) - 1) {
    const Float4 extent = centres.upper - centres.lower;
    const float longest = std::max({static_cast<float>(extent[0]), static_cast<float>(extent[1]), static_cast<float>(extent[2])});
    // A shade below the number of cells, so that the last centre lies in the last cell. Where all centres agree, so do all codes.
    const float ratio = static_cast<float>(1 << bits) * (1.0F - 0x1p-22F) / longest;
    if (longest > 0.0F && ratio <= std::numeric_limits<float>::max()) scale_ = ratio;
  }

  [[nodiscard]] std::uint64_t code(Float4 doubled_centre) const {
    const Int4 cell = __builtin_convertvector((doubled_centre - lower_) * splat(scale_), Int4);
    const auto clamped = [&](int axis) { return static_cast<std::uint32_t>(std::clamp(static_cast<std::int32_t>(cell[axis]), 0, most_)); };
    return morton_code(clamped(0), clamped(1), clamped(2));
  }

 private:
  Float4 lower_;
  float scale_ = 0.0F;
  std::int32_t most_;
};

// So many primitives may share a code: they are a leaf or two. The two triangles of a quadrilateral often have the same centre, whatever the grid.
constexpr std::size_t kShared = 4;

// Whether more than one in 16 of sorted codes is shared by more than kShared.
template <typename CodeOf>
bool are_crowded(std::size_t size, const CodeOf& code_of) {
  std::vector<std::size_t> equal((size + kGrain - 1) / kGrain, 0);
  parallel_chunks(size, kGrain, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    for (std::size_t i = std::max(first, kShared); i < last; ++i) equal[chunk] += code_of(i) == code_of(i - kShared) ? 1 : 0;
  });
  std::size_t total = 0;
  for (const std::size_t count : equal) total += count;
  return 16 * total > size;
}

}  // namespace

MortonOrder sort_by_morton_code(const ReferenceList& list) {
  const std::size_t size = list.references.size();
  const Box4 centres = measure_all(list.references).centres;
  {
    // Code and index share a word, the index in the low bits, so that equal codes stay in order of index.
    const int index_bits = std::bit_width(size);
    const int bits = std::min(kCoarseBits, (64 - index_bits) / 3);
    const std::uint64_t index_mask = (std::uint64_t{1} << index_bits) - 1;
    const Grid grid(centres, bits);
    HugeVector<std::uint64_t> words(size);
    parallel_for(size, kGrain, [&](std::size_t i) { words[i] = grid.code(list.references[i].doubled_centre()) << index_bits | i; });
    radix_sort(words, index_bits, index_bits + 3 * bits);
    const auto code_of = [&](std::size_t i) { return words[i] >> index_bits; };
    if (!are_crowded(size, code_of)) {
      MortonOrder order{{}, HugeVector<std::uint32_t>(size)};
      parallel_for(size, kGrain, [&](std::size_t i) {
        order.indices[i] = static_cast<std::uint32_t>(words[i] & index_mask);
        words[i] >>= index_bits;
      });
      order.codes = std::move(words);
      return order;
    }
  }
  const Grid grid(centres, kFineBits);
  HugeVector<KeyedIndex> items(size);
  parallel_for(size, kGrain, [&](std::size_t i) {
    items[i] = {grid.code(list.references[i].doubled_centre()), static_cast<std::uint32_t>(i)};
  });
  radix_sort(items, 3 * kFineBits);
  MortonOrder order{HugeVector<std::uint64_t>(size), HugeVector<std::uint32_t>(size)};
  parallel_for(size, kGrain, [&](std::size_t i) {
    order.codes[i] = items[i].key;
    order.indices[i] = items[i].index;
  });
  return order;
}

HugeVector<PrimitiveReference> gather(const ReferenceList& list, const MortonOrder& order) {
  HugeVector<PrimitiveReference> references(list.references.size());
  parallel_for(references.size(), kGrain, [&](std::size_t i) { references[i] = list.references[order.indices[i]]; });
  return references;
}

}  // namespace grove
