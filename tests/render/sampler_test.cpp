#include "grove/render/sampling/sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "statistics.h"

namespace grove {
namespace {

TEST(Sampler, IsAPureFunctionOfItsArguments) {
  const Sampler first(7, 11, 13, 5);
  const Sampler again(7, 11, 13, 5);
  const Vec2 early = first.sample_2d(3);
  (void)first.sample_2d(9);
  EXPECT_EQ(first.sample_2d(3), early);
  EXPECT_EQ(again.sample_2d(3), early);
  EXPECT_EQ(again.sample_1d(3), early.x);
  EXPECT_NE(Sampler(8, 11, 13, 5).sample_2d(3), early);
  EXPECT_NE(Sampler(7, 12, 13, 5).sample_2d(3), early);
  EXPECT_NE(Sampler(7, 11, 14, 5).sample_2d(3), early);
  EXPECT_NE(Sampler(7, 11, 13, 6).sample_2d(3), early);
  EXPECT_NE(first.sample_2d(4), early);
}

// Every box of area 2^-k with sides that are powers of two holds exactly one of the first 2^k points.
TEST(Sampler, FirstPowersOfTwoAreNets) {
  for (std::uint32_t dimension : {0U, 1U, 17U, 0x80000003U}) {
    for (std::uint32_t k = 1; k <= 8; ++k) {
      const std::uint32_t count = 1U << k;
      for (std::uint32_t columns_log = 0; columns_log <= k; ++columns_log) {
        const std::uint32_t columns = 1U << columns_log;
        const std::uint32_t rows = count / columns;
        std::set<std::uint32_t> boxes;
        for (std::uint32_t s = 0; s < count; ++s) {
          const Vec2 p = Sampler(1, 2, 3, s).sample_2d(dimension);
          ASSERT_TRUE(p.x >= 0.0F && p.x < 1.0F && p.y >= 0.0F && p.y < 1.0F);
          const auto x = static_cast<std::uint32_t>(p.x * static_cast<float>(columns));
          const auto y = static_cast<std::uint32_t>(p.y * static_cast<float>(rows));
          boxes.insert(y * columns + x);
        }
        ASSERT_EQ(boxes.size(), count) << "dimension " << dimension << ", " << columns << " x " << rows;
      }
    }
  }
}

// The first point of a set, over pixels, must be uniform: scrambling, not the sequence, decides it.
TEST(Sampler, IsUniformOverPixels) {
  constexpr int kSide = 16;
  std::vector<double> observed(kSide * kSide);
  constexpr int kPixels = 256;
  for (std::uint32_t y = 0; y < kPixels; ++y) {
    for (std::uint32_t x = 0; x < kPixels; ++x) {
      const Vec2 p = Sampler(0, x, y, 3).sample_2d(2);
      ++observed[static_cast<std::size_t>(p.y * kSide) * kSide + static_cast<std::size_t>(p.x * kSide)];
    }
  }
  const std::vector<double> expected(observed.size(), kPixels * kPixels / static_cast<double>(observed.size()));
  EXPECT_GT(testing::chi_squared_fit(observed, expected), 1e-4);
}

// Two sets of one sample, and the same set of neighbouring pixels, must not know of each other.
TEST(Sampler, SetsAndPixelsAreIndependent) {
  constexpr int kSide = 8;
  std::vector<double> sets(kSide * kSide);
  std::vector<double> pixels(kSide * kSide);
  constexpr std::uint32_t kCount = 40000;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const float a = Sampler(0, i, 0, i % 16).sample_1d(5);
    const float b = Sampler(0, i, 0, i % 16).sample_1d(6);
    const float c = Sampler(0, i + 1, 0, i % 16).sample_1d(5);
    ++sets[static_cast<std::size_t>(a * kSide) * kSide + static_cast<std::size_t>(b * kSide)];
    ++pixels[static_cast<std::size_t>(a * kSide) * kSide + static_cast<std::size_t>(c * kSide)];
  }
  const std::vector<double> expected(sets.size(), kCount / static_cast<double>(sets.size()));
  EXPECT_GT(testing::chi_squared_fit(sets, expected), 1e-4);
  EXPECT_GT(testing::chi_squared_fit(pixels, expected), 1e-4);
}

// Student's test of an integral with a known value, over independent pixels; and far less variance than independent samples have.
TEST(Sampler, IntegratesSmoothFunctionsWithoutBiasAndWithLittleVariance) {
  const auto f = [](const Vec2& p) { return std::exp(static_cast<double>(p.x)) * std::cos(static_cast<double>(p.y)); };
  const double exact = (std::exp(1.0) - 1.0) * std::sin(1.0);
  constexpr std::uint32_t kPixels = 400;
  constexpr std::uint32_t kSamples = 64;
  double sum = 0.0;
  double sum_squares = 0.0;
  double point_squares = 0.0;
  for (std::uint32_t pixel = 0; pixel < kPixels; ++pixel) {
    double mean = 0.0;
    for (std::uint32_t s = 0; s < kSamples; ++s) {
      const double value = f(Sampler(4, pixel, 9, s).sample_2d(7));
      mean += value / kSamples;
      point_squares += (value - exact) * (value - exact);
    }
    sum += mean - exact;
    sum_squares += (mean - exact) * (mean - exact);
  }
  const double variance = sum_squares / kPixels;
  EXPECT_LT(std::fabs(sum / kPixels), 4.0 * std::sqrt(variance / kPixels));
  const double independent_variance = point_squares / (kPixels * kSamples) / kSamples;
  EXPECT_LT(variance, independent_variance / 50.0);
}

}  // namespace
}  // namespace grove
