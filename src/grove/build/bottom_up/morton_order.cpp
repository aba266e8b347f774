#include "grove/build/bottom_up/morton_order.h"

#include <algorithm>
#include <limits>

#include "grove/base/parallel.h"
#include "grove/build/reference_range.h"
#include "grove/math/morton.h"

namespace grove {
namespace {

constexpr std::size_t kGrain = 16384;
constexpr int kCoarseBits = 14;
constexpr int kFineBits = 21;

void make_codes(const HugeVector<PrimitiveReference>& references, const Box4& centres, int bits, HugeVector<KeyedIndex>& items) {
  const Float4 extent = centres.upper - centres.lower;
  const float longest = std::max({static_cast<float>(extent[0]), static_cast<float>(extent[1]), static_cast<float>(extent[2])});
  const auto cells = static_cast<float>(1U << static_cast<unsigned>(bits));
  // A shade below the number of cells, so that the last centre lies in the last cell. Where all centres agree, so do all codes.
  const float ratio = cells * (1.0F - 0x1p-22F) / longest;
  const float scale = longest > 0.0F && ratio <= std::numeric_limits<float>::max() ? ratio : 0.0F;
  const auto most = static_cast<std::int32_t>(cells) - 1;
  parallel_for(references.size(), kGrain, [&](std::size_t i) {
    const Int4 cell = __builtin_convertvector((references[i].doubled_centre() - centres.lower) * splat(scale), Int4);
    const auto clamped = [&](int axis) { return static_cast<std::uint32_t>(std::clamp(static_cast<std::int32_t>(cell[axis]), 0, most)); };
    items[i] = {morton_code(clamped(0), clamped(1), clamped(2)), static_cast<std::uint32_t>(i)};
  });
  radix_sort(items, 3 * bits);
}

bool are_crowded(const HugeVector<KeyedIndex>& items) {
  std::vector<std::size_t> equal((items.size() + kGrain - 1) / kGrain, 0);
  parallel_chunks(items.size(), kGrain, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    for (std::size_t i = std::max<std::size_t>(first, 1); i < last; ++i) equal[chunk] += items[i].key == items[i - 1].key ? 1 : 0;
  });
  std::size_t total = 0;
  for (const std::size_t count : equal) total += count;
  return 16 * total > items.size();
}

}  // namespace

MortonOrder sort_by_morton_code(const ReferenceList& list) {
  const Box4 centres = measure_all(list.references).centres;
  HugeVector<KeyedIndex> items(list.references.size());
  make_codes(list.references, centres, kCoarseBits, items);
  if (are_crowded(items)) make_codes(list.references, centres, kFineBits, items);
  MortonOrder order;
  order.references.resize(items.size());
  order.codes.resize(items.size());
  parallel_for(items.size(), kGrain, [&](std::size_t i) {
    order.references[i] = list.references[items[i].index];
    order.codes[i] = items[i].key;
  });
  return order;
}

}  // namespace grove
