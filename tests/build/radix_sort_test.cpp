#include "grove/build/bottom_up/radix_sort.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "build/threads.h"
#include "grove/base/random.h"

namespace grove {
namespace {

// Around one chunk, and several.
constexpr std::size_t kSizes[] = {0, 1, 2, 3, 1000, 65535, 65536, 65537, 200000};

bool same(const HugeVector<KeyedIndex>& a, const HugeVector<KeyedIndex>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const KeyedIndex& x, const KeyedIndex& y) { return x.key == y.key && x.index == y.index; });
}

HugeVector<KeyedIndex> random_items(std::size_t size, int bits, std::uint64_t key_count, std::uint64_t seed) {
  Random random(seed);
  HugeVector<KeyedIndex> items(size);
  const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
  // Few keys are spread over all bits.
  for (std::size_t i = 0; i < size; ++i)
    items[i] = {mix_bits(random.next_u64() % key_count + 1) & mask, static_cast<std::uint32_t>(random.next_u64())};
  return items;
}

TEST(RadixSort, SortsAsAStableSortDoes) {
  for (const std::size_t size : kSizes) {
    for (const int bits : {1, 10, 11, 12, 42, 63}) {
      for (const std::uint64_t key_count : {std::uint64_t{1}, std::uint64_t{5}, std::uint64_t{1} << 40}) {
        HugeVector<KeyedIndex> items = random_items(size, bits, key_count, size + key_count);
        HugeVector<KeyedIndex> expected = items;
        std::stable_sort(expected.begin(), expected.end(), [](const KeyedIndex& a, const KeyedIndex& b) { return a.key < b.key; });
        radix_sort(items, bits);
        EXPECT_TRUE(same(items, expected)) << size << " items of " << bits << " bits, " << key_count << " keys";
      }
    }
  }
}

TEST(RadixSort, SortsWordsBySomeOfTheirBits) {
  for (const std::size_t size : kSizes) {
    Random random(size);
    HugeVector<std::uint64_t> words(size);
    for (std::uint64_t& word : words) word = random.next_u64();
    for (const auto& [first_bit, end_bit] : {std::pair(0, 64), {20, 62}, {17, 28}, {63, 64}, {5, 5}}) {
      // Bits from end_bit on must not be set where the last digit reaches beyond them.
      HugeVector<std::uint64_t> sorted = words;
      for (std::uint64_t& word : sorted)
        if (end_bit < 64) word &= (std::uint64_t{1} << end_bit) - 1;
      HugeVector<std::uint64_t> expected = sorted;
      std::stable_sort(expected.begin(), expected.end(),
                       [first = first_bit](std::uint64_t a, std::uint64_t b) { return a >> first < b >> first; });
      radix_sort(sorted, first_bit, end_bit);
      EXPECT_EQ(sorted, expected) << size << " words by bits " << first_bit << " to " << end_bit;
    }
  }
}

TEST(RadixSort, DoesNotDependOnTheThreads) {
  const HugeVector<KeyedIndex> items = random_items(300000, 42, 5000, 1);
  const auto sort_with = [&](int threads) {
    return testing::with_threads(threads, [&] {
      HugeVector<KeyedIndex> sorted = items;
      radix_sort(sorted, 42);
      return sorted;
    });
  };
  const HugeVector<KeyedIndex> one = sort_with(1);
  for (const int threads : {2, 3, 8}) EXPECT_TRUE(same(sort_with(threads), one)) << threads;
}

}  // namespace
}  // namespace grove
