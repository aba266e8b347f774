#include "grove/build/bottom_up/radix_sort.h"

#include <array>
#include <utility>
#include <vector>

#include "grove/base/parallel.h"

namespace grove {
namespace {

constexpr int kDigitBits = 12;
constexpr std::size_t kDigitCount = std::size_t{1} << kDigitBits;
constexpr std::size_t kChunk = 65536;

template <typename Item, typename KeyOf>
void sort_by_digits(HugeVector<Item>& items, int first_bit, int end_bit, const KeyOf& key_of) {
  const std::size_t size = items.size();
  if (size < 2) return;
  HugeVector<Item> other(size);
  using Histogram = std::array<std::uint32_t, kDigitCount>;
  std::vector<Histogram> histograms((size + kChunk - 1) / kChunk);
  for (int shift = first_bit; shift < end_bit; shift += kDigitBits) {
    const auto digit = [&](const Item& item) { return (key_of(item) >> shift) & (kDigitCount - 1); };
    parallel_chunks(size, kChunk, [&](std::size_t chunk, std::size_t first, std::size_t last) {
      Histogram& histogram = histograms[chunk];
      histogram.fill(0);
      for (std::size_t i = first; i < last; ++i) ++histogram[digit(items[i])];
    });
    // From counts to the first place of each digit of each chunk.
    std::uint32_t place = 0;
    bool is_constant = false;
    for (std::size_t d = 0; d < kDigitCount; ++d) {
      const std::uint32_t before = place;
      for (Histogram& histogram : histograms) place += std::exchange(histogram[d], place);
      is_constant = is_constant || place - before == size;
    }
    if (is_constant) continue;
    parallel_chunks(size, kChunk, [&](std::size_t chunk, std::size_t first, std::size_t last) {
      Histogram& next = histograms[chunk];
      for (std::size_t i = first; i < last; ++i) other[next[digit(items[i])]++] = items[i];
    });
    items.swap(other);
  }
}

}  // namespace

void radix_sort(HugeVector<std::uint64_t>& words, int first_bit, int end_bit) {
  sort_by_digits(words, first_bit, end_bit, [](std::uint64_t word) { return word; });
}

void radix_sort(HugeVector<KeyedIndex>& items, int bits) {
  sort_by_digits(items, 0, bits, [](const KeyedIndex& item) { return item.key; });
}

}  // namespace grove
