#include "grove/base/huge_vector.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <new>
#include <numeric>

namespace grove {
namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20;

TEST(HugeVector, BlocksAreAlignedToCacheLinesAndCanBeWrittenToTheirEnds) {
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{1}, std::size_t{100}, 4 * kMiB - 1, 4 * kMiB, 5 * kMiB + 1, 64 * kMiB}) {
    void* const memory = allocate_huge(bytes);
    ASSERT_NE(memory, nullptr);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory) % 64, 0U) << bytes;
    auto* const begin = static_cast<unsigned char*>(memory);
    if (bytes > 0) {
      begin[0] = 1;
      begin[bytes - 1] = 2;
      EXPECT_EQ(begin[bytes - 1], 2);
    }
    free_huge(memory, bytes);
  }
}

TEST(HugeVector, KeepsItsElementsWhenItGrowsAndMoves) {
  HugeVector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < 3'000'000; ++i) numbers.push_back(i);
  HugeVector<std::uint32_t> moved = std::move(numbers);
  moved.resize(2'000'000);
  moved.shrink_to_fit();
  EXPECT_EQ(std::accumulate(moved.begin(), moved.end(), std::uint64_t{0}), std::uint64_t{1'999'999} * 1'000'000);
}

TEST(HugeVector, TooMuchIsABadAllocation) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer ends the program where memory cannot be had";
#endif
  const std::size_t most = std::numeric_limits<std::size_t>::max();
  for (const std::size_t bytes : {most, most - 2 * kMiB, most / 2, most / 4})
    EXPECT_THROW(static_cast<void>(allocate_huge(bytes)), std::bad_alloc) << bytes;
}

}  // namespace
}  // namespace grove
