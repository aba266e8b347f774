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
// Per axis. Coarse codes take three passes of sorting, fine ones would take six.
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

// How many of sorted codes are the same as the one `distance` places before.
template <typename CodeOf>
std::size_t count_equal(std::size_t size, std::size_t distance, const CodeOf& code_of) {
  std::vector<std::size_t> equal((size + kGrain - 1) / kGrain, 0);
  parallel_chunks(size, kGrain, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    for (std::size_t i = std::max(first, distance); i < last; ++i) equal[chunk] += code_of(i) == code_of(i - distance) ? 1 : 0;
  });
  std::size_t total = 0;
  for (const std::size_t count : equal) total += count;
  return total;
}

// Of so many references with one code, one task makes an order.
constexpr std::size_t kLongestRun = 65536;

// From an order by coarse codes to the one by fine codes: their upper bits are the coarse ones, so that only references that share one change places.
// The lower bits stay 0 where a coarse code is not shared.
void refine(const ReferenceList& list, const Box4& centres, MortonOrder& order) {
  const Grid grid(centres, kFineBits);
  const std::size_t size = order.codes.size();
  const auto begins_run = [&](std::size_t i) { return i == 0 || i >= size || order.codes[i] != order.codes[i - 1]; };
  std::vector<std::size_t> borders((size + kGrain - 1) / kGrain + 1, size);
  parallel_for(borders.size() - 1, 1, [&](std::size_t chunk) {
    std::size_t border = chunk * kGrain;
    while (!begins_run(border)) ++border;
    borders[chunk] = border;
  });
  constexpr std::size_t kAhead = 16;
  parallel_for(borders.size() - 1, 1, [&](std::size_t chunk) {
    std::vector<KeyedIndex> items;
    std::size_t end = borders[chunk];
    for (std::size_t begin = end; begin < borders[chunk + 1]; begin = end) {
      __builtin_prefetch(&list.references[order.indices[std::min(begin + kAhead, size - 1)]]);
      end = begin + 1;
      // What lies behind the border may be changing.
      while (end < borders[chunk + 1] && !begins_run(end)) ++end;
      if (end - begin == 1) continue;
      items.resize(end - begin);
      for (std::size_t i = begin; i < end; ++i)
        items[i - begin] = {grid.code(list.references[order.indices[i]].doubled_centre()), order.indices[i]};
      std::sort(items.begin(), items.end(),
                [](const KeyedIndex& a, const KeyedIndex& b) { return a.key != b.key ? a.key < b.key : a.index < b.index; });
      for (std::size_t i = begin; i < end; ++i) {
        order.codes[i] = items[i - begin].key;
        order.indices[i] = items[i - begin].index;
      }
    }
  });
}

MortonOrder sort_by_fine_codes(const ReferenceList& list, const Box4& centres) {
  const std::size_t size = list.references.size();
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

}  // namespace

MortonOrder sort_by_morton_code(const ReferenceList& list) {
  const std::size_t size = list.references.size();
  const Box4 centres = measure_all(list.references).centres;
  // Code and index share a word, the index in the low bits, so that equal codes stay in order of index.
  const int index_bits = std::bit_width(size);
  const int bits = std::min(kCoarseBits, (64 - index_bits) / 3);
  const std::uint64_t index_mask = (std::uint64_t{1} << index_bits) - 1;
  const Grid grid(centres, bits);
  HugeVector<std::uint64_t> words(size);
  parallel_for(size, kGrain, [&](std::size_t i) { words[i] = grid.code(list.references[i].doubled_centre()) << index_bits | i; });
  radix_sort(words, index_bits, index_bits + 3 * bits);
  const auto code_of = [&](std::size_t i) { return words[i] >> index_bits; };
  const bool is_crowded = 16 * count_equal(size, kShared, code_of) > size;
  if (is_crowded && count_equal(size, kLongestRun, code_of) > 0) return sort_by_fine_codes(list, centres);
  MortonOrder order{{}, HugeVector<std::uint32_t>(size)};
  parallel_for(size, kGrain, [&](std::size_t i) {
    order.indices[i] = static_cast<std::uint32_t>(words[i] & index_mask);
    words[i] = (words[i] >> index_bits) << (3 * (is_crowded ? kFineBits - bits : 0));
  });
  order.codes = std::move(words);
  if (is_crowded) refine(list, centres, order);
  return order;
}

HugeVector<PrimitiveReference> gather(const ReferenceList& list, const MortonOrder& order) {
  HugeVector<PrimitiveReference> references(list.references.size());
  parallel_for(references.size(), kGrain, [&](std::size_t i) { references[i] = list.references[order.indices[i]]; });
  return references;
}

}  // namespace grove
