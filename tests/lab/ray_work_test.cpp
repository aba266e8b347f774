#include "grove/lab/ray_work.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace grove {

static void PrintTo(const StepsBin& bin, std::ostream* stream) {
  *stream << bin.first << ": " << bin.rays;
}

namespace {

TraversalCounts counts_of(std::uint64_t nodes, std::uint64_t tests) {
  TraversalCounts counts;
  counts.nodes_visited = nodes;
  counts.primitives_tested = tests;
  return counts;
}

TEST(RayWork, OfNoRaysIsNothing) {
  const RayWork work = work_of({});
  EXPECT_EQ(work.nodes, CountSpread{});
  EXPECT_THAT(work.steps, ::testing::IsEmpty());
}

TEST(RayWork, HasMeanAndPercentileAndMaximum) {
  std::vector<TraversalCounts> counts;
  for (std::uint64_t i = 1; i <= 100; ++i) counts.push_back(counts_of(101 - i, 7));
  const RayWork work = work_of(counts);
  EXPECT_EQ(work.nodes, (CountSpread{50.5, 95, 100}));
  EXPECT_EQ(work.tests, (CountSpread{7.0, 7, 7}));
  EXPECT_EQ(work_of(std::span(counts).first(1)).nodes, (CountSpread{100.0, 100, 100}));
}

TEST(RayWork, PercentileIsTheLeastCountThatNineteenOfTwentyDoNotExceed) {
  std::vector<TraversalCounts> counts(20, counts_of(1, 0));
  counts[3] = counts_of(50, 0);
  EXPECT_EQ(work_of(counts).nodes.p95, 1U) << "19 of 20 are at most 1";
  counts[4] = counts_of(40, 0);
  EXPECT_EQ(work_of(counts).nodes.p95, 40U);
}

TEST(RayWork, StepsFallIntoTwoBinsForEachPowerOfTwo) {
  std::vector<TraversalCounts> counts;
  for (std::uint64_t i = 0; i <= 17; ++i) counts.push_back(counts_of(i / 2, i - i / 2));
  const std::vector<StepsBin> expected{{0, 1}, {1, 1}, {2, 1}, {3, 1}, {4, 2}, {6, 2}, {8, 4}, {12, 4}, {16, 2}};
  EXPECT_EQ(work_of(counts).steps, expected);
  EXPECT_EQ(work_of(std::span(counts).subspan(4)).steps.front(), (StepsBin{4, 2})) << "begins with the first that has rays";
}

}  // namespace
}  // namespace grove
