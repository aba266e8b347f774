#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "grove/base/random.h"
#include "grove/render/sampling/alias_table.h"
#include "grove/render/sampling/distribution_2d.h"
#include "grove/render/sampling/warp.h"
#include "statistics.h"

namespace grove {
namespace {

constexpr std::uint64_t kSeed = 20221;

TEST(AliasTable, DrawsInProportion) {
  const std::vector<float> weights = {3.0F, 0.0F, 1.0F, 0.5F, 10.0F, 1e-6F, 7.0F, 2.5F};
  const AliasTable table(weights);
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  double total = 0.0;
  for (std::uint32_t i = 0; i < weights.size(); ++i) {
    EXPECT_NEAR(table.probability(i), static_cast<double>(weights[i]) / sum, 1e-7);
    total += static_cast<double>(table.probability(i));
  }
  EXPECT_NEAR(total, 1.0, 1e-6);
  // An even walk over [0, 1) meets each entry exactly as often as it should, up to the borders.
  constexpr int kSteps = 1 << 18;
  std::vector<double> observed(weights.size());
  for (int i = 0; i < kSteps; ++i) {
    const AliasTable::Draw draw = table.draw((static_cast<float>(i) + 0.5F) / kSteps);
    ASSERT_LT(draw.index, weights.size());
    ASSERT_TRUE(draw.u >= 0.0F && draw.u < 1.0F);
    ASSERT_EQ(draw.probability, table.probability(draw.index));
    observed[draw.index] += 1.0 / kSteps;
  }
  for (std::size_t i = 0; i < weights.size(); ++i) EXPECT_NEAR(observed[i], static_cast<double>(weights[i]) / sum, 1e-4);
  EXPECT_EQ(observed[1], 0.0);
}

TEST(AliasTable, LeavesAFreshUniformNumber) {
  const AliasTable table(std::vector<float>{1.0F, 2.0F, 5.0F});
  constexpr std::size_t kBins = 10;
  std::vector<double> observed(3 * kBins);
  constexpr int kSteps = 200000;
  for (int i = 0; i < kSteps; ++i) {
    const AliasTable::Draw draw = table.draw((static_cast<float>(i) + 0.5F) / kSteps);
    ++observed[draw.index * kBins + static_cast<std::size_t>(draw.u * kBins)];
  }
  for (std::uint32_t i = 0; i < 3; ++i) {
    const double expected = kSteps * static_cast<double>(table.probability(i)) / kBins;
    for (std::size_t bin = 0; bin < kBins; ++bin) EXPECT_NEAR(observed[i * kBins + bin], expected, 8.0);
  }
}

TEST(AliasTable, BadWeightsCountAsNone) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const AliasTable table(std::vector<float>{nan, -1.0F, 2.0F, std::numeric_limits<float>::infinity()});
  EXPECT_EQ(table.draw(0.1F).index, 2U);
  EXPECT_EQ(table.draw(0.9F).index, 2U);
  const AliasTable even(std::vector<float>{0.0F, 0.0F});
  EXPECT_EQ(even.probability(0), 0.5F);
  EXPECT_EQ(even.draw(0.75F).index, 1U);
}

TEST(Distribution2D, DensityIntegratesToOneAndMatchesDraws) {
  constexpr std::uint32_t kWidth = 7;
  constexpr std::uint32_t kHeight = 5;
  Random random(kSeed);
  std::vector<float> weights;
  for (std::uint32_t i = 0; i < kWidth * kHeight; ++i) weights.push_back(i % 6 == 2 ? 0.0F : random.next_float(0.0F, 3.0F));
  const Distribution2D distribution(weights, kWidth, kHeight);
  std::vector<double> expected(weights.size());
  double integral = 0.0;
  constexpr int kDraws = 100000;
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const Vec2 centre((static_cast<float>(x) + 0.5F) / kWidth, (static_cast<float>(y) + 0.5F) / kHeight);
      const double mass = static_cast<double>(distribution.density(centre)) / (kWidth * kHeight);
      integral += mass;
      expected[y * kWidth + x] = mass * kDraws;
    }
  }
  EXPECT_NEAR(integral, 1.0, 1e-5);
  std::vector<double> observed(weights.size());
  for (int i = 0; i < kDraws; ++i) {
    const Distribution2D::Draw draw = distribution.draw({random.next_float(), random.next_float()});
    const auto x = std::min<std::size_t>(kWidth - 1, static_cast<std::size_t>(draw.point.x * kWidth));
    const auto y = std::min<std::size_t>(kHeight - 1, static_cast<std::size_t>(draw.point.y * kHeight));
    ++observed[y * kWidth + x];
    EXPECT_GT(draw.density, 0.0F);
  }
  EXPECT_GT(testing::chi_squared_fit(observed, expected), 1e-4) << "seed " << kSeed;
}

TEST(Distribution2D, AllBlackIsUniform) {
  const Distribution2D distribution(std::vector<float>(12, 0.0F), 4, 3);
  EXPECT_NEAR(distribution.density({0.1F, 0.9F}), 1.0F, 1e-5F);
  EXPECT_NEAR(distribution.draw({0.3F, 0.6F}).density, 1.0F, 1e-5F);
}

TEST(Warp, MapsKeepTheirDensities) {
  Random random(kSeed);
  double cosine = 0.0;
  double sphere_z = 0.0;
  double sphere_z2 = 0.0;
  double barycentric[2] = {0.0, 0.0};
  double tent = 0.0;
  constexpr int kCount = 200000;
  for (int i = 0; i < kCount; ++i) {
    const Vec2 u(random.next_float(), random.next_float());
    const Vec3 hemisphere = sample_cosine_hemisphere(u);
    ASSERT_NEAR(glm::length(hemisphere), 1.0F, 1e-5F);
    cosine += static_cast<double>(hemisphere.z);
    const Vec3 sphere = sample_sphere(u);
    sphere_z += static_cast<double>(sphere.z);
    sphere_z2 += static_cast<double>(sphere.z * sphere.z);
    const Vec2 triangle = sample_triangle(u);
    ASSERT_TRUE(triangle.x >= 0.0F && triangle.y >= 0.0F && triangle.x + triangle.y <= 1.000001F);
    barycentric[0] += static_cast<double>(triangle.x);
    barycentric[1] += static_cast<double>(triangle.y);
    const float offset = sample_tent(u.x);
    ASSERT_LE(std::fabs(offset), 1.0F);
    tent += static_cast<double>(offset * offset);
  }
  EXPECT_NEAR(cosine / kCount, 2.0 / 3.0, 0.004);
  EXPECT_NEAR(sphere_z / kCount, 0.0, 0.006);
  EXPECT_NEAR(sphere_z2 / kCount, 1.0 / 3.0, 0.004);
  EXPECT_NEAR(barycentric[0] / kCount, 1.0 / 3.0, 0.003);
  EXPECT_NEAR(barycentric[1] / kCount, 1.0 / 3.0, 0.003);
  EXPECT_NEAR(tent / kCount, 1.0 / 6.0, 0.003);
}

TEST(Warp, PowerHeuristicSharesAllWeightAndSurvivesExtremes) {
  EXPECT_NEAR(power_heuristic(2.0F, 5.0F) + power_heuristic(5.0F, 2.0F), 1.0F, 1e-6F);
  EXPECT_EQ(power_heuristic(1e30F, 1e-30F), 1.0F);
  EXPECT_EQ(power_heuristic(1e-30F, 1e30F), 0.0F);
  EXPECT_EQ(power_heuristic(0.0F, 1.0F), 0.0F);
}

}  // namespace
}  // namespace grove
