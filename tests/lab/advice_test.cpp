#include "grove/lab/advice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "grove/lab/break_even.h"
#include "grove/lab/comparison_report.h"
#include "grove/lab/predictions.h"

namespace grove {
namespace {

using ::testing::HasSubstr;

/// A row that takes so long to build, to follow, and for a ray.
ComparisonRow timed_row(const std::string& structure, double build_seconds, double nanoseconds, std::uint64_t bytes) {
  ComparisonRow row;
  row.structure = structure;
  row.rays = "primary";
  const double rate = 1e3 / nanoseconds;
  row.mrays_per_s = {rate, rate, rate};
  row.build_seconds = {build_seconds, build_seconds, build_seconds};
  row.update = UpdateTrial{UpdateMethod::rebuild, build_seconds};
  row.bytes = bytes;
  row.is_described = row.is_counted = true;
  return row;
}

/// One that is quick to build, one that is quick to trace, one between that is small, and one that is never the quickest.
Comparison four_structures() {
  Comparison comparison;
  comparison.primitives = 100;
  comparison.rows = {timed_row("kdtree", 10.0, 100.0, 5000), timed_row("bvh:split=lbvh", 0.001, 400.0, 4000),
                     timed_row("bvh", 0.1, 190.0, 3000), timed_row("octree", 5.0, 1000.0, 1000)};
  return comparison;
}

std::string structure_for(const std::vector<Advice>& advice, const std::string& use) {
  for (const Advice& one : advice)
    if (one.use == use) return one.structure;
  return "";
}

TEST(BreakEven, IsTheLowerEnvelope) {
  const std::vector<BreakEven> all = break_even(four_structures().rows);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].rays, "primary");
  EXPECT_EQ(all[0].times.size(), 4U);
  ASSERT_EQ(all[0].quickest.size(), 3U);
  EXPECT_EQ(all[0].quickest[0].rays, 0.0);
  EXPECT_EQ(all[0].quickest[0].structure, "bvh:split=lbvh");
  EXPECT_EQ(all[0].quickest[1].structure, "bvh");
  EXPECT_NEAR(all[0].quickest[1].rays, 0.099 / 210e-9, 1.0);
  EXPECT_EQ(all[0].quickest[2].structure, "kdtree");
  EXPECT_NEAR(all[0].quickest[2].rays, 9.9 / 90e-9, 100.0);
}

TEST(BreakEven, LeavesOutWhatHasNoTimes) {
  std::vector<ComparisonRow> rows = four_structures().rows;
  for (ComparisonRow& row : rows) row.error = "out of memory";
  EXPECT_THAT(break_even(rows), ::testing::IsEmpty());
}

TEST(Advice, RestsOnWhatEachUseNeeds) {
  const Comparison comparison = four_structures();
  const std::vector<Advice> advice = advise(comparison);
  ASSERT_EQ(advice.size(), 5U);
  EXPECT_EQ(structure_for(advice, "static offline"), "kdtree") << "10 s and 100 s against 190 s";
  EXPECT_EQ(structure_for(advice, "static interactive"), "bvh") << "0.48 s against 0.80 s";
  EXPECT_EQ(structure_for(advice, "moving vertices"), "bvh");
  EXPECT_EQ(structure_for(advice, "moving objects"), "kdtree");
  EXPECT_EQ(structure_for(advice, "memory-bound"), "bvh") << "the octree is smaller, but ten times as slow as the fastest";
  for (const Advice& one : advice) EXPECT_THAT(one.why, ::testing::ContainsRegex("[0-9]")) << one.use;
  EXPECT_THAT(advice[0].why, HasSubstr("next is bvh"));
}

TEST(Advice, ARefitMakesMovingVerticesCheap) {
  Comparison comparison = four_structures();
  comparison.rows[1].update = UpdateTrial{UpdateMethod::refit, 1e-4};
  comparison.rows[2].update = UpdateTrial{UpdateMethod::rebuild, 2.0};
  const std::vector<Advice> advice = advise(comparison);
  EXPECT_EQ(structure_for(advice, "moving vertices"), "bvh:split=lbvh");
  EXPECT_THAT(advice[2].why, HasSubstr("refit"));
}

TEST(Advice, LeavesOutWhatFailedAndSaysNothingOfNothing) {
  Comparison comparison = four_structures();
  comparison.rows[0].error = "3 of 100 hits are not the reference's";
  EXPECT_EQ(structure_for(advise(comparison), "static offline"), "bvh");
  for (ComparisonRow& row : comparison.rows) row.error = "out of memory";
  EXPECT_THAT(advise(comparison), ::testing::IsEmpty());
  EXPECT_EQ(comparison_advice(comparison), "");
}

TEST(Predictions, RecoverThePricesOfStepsAndTests) {
  std::vector<ComparisonRow> rows;
  for (int i = 0; i < 8; ++i) {
    const double nodes = 10.0 + 3.0 * i;
    const double tests = 5.0 + static_cast<double>(i * i % 7);
    ComparisonRow row = timed_row("bvh:leaf-size=" + std::to_string(i + 1), 1.0, 20.0 + 4.0 * nodes + 9.0 * tests, 1000);
    row.work.nodes.mean = nodes;
    row.work.tests.mean = tests;
    row.expected_cost = nodes + 0.35 * tests;
    rows.push_back(row);
  }
  const std::vector<ReportSection> sections = predictions(rows);
  ASSERT_EQ(sections.size(), 2U);
  ASSERT_TRUE(sections[0].table.has_value());
  const std::vector<ReportCell>& fit = sections[0].table->rows.at(0);
  EXPECT_EQ(std::get<std::string>(fit[0]), "bvh");
  EXPECT_NEAR(std::get<double>(fit[2]), 20.0, 0.01);
  EXPECT_NEAR(std::get<double>(fit[3]), 4.0, 0.001);
  EXPECT_NEAR(std::get<double>(fit[4]), 9.0, 0.001);
  EXPECT_NEAR(std::get<double>(fit[5]), 1.0, 1e-6);
  ASSERT_TRUE(sections[0].plot.has_value());
  EXPECT_EQ(sections[0].plot->series.at(0).points.size(), 8U);
  EXPECT_GT(std::get<double>(sections[1].table->rows.at(0)[2]), 0.8) << "the expected cost and the time";
}

TEST(Predictions, NeedEnoughRows) {
  EXPECT_THAT(predictions(four_structures().rows), ::testing::IsEmpty());
}

}  // namespace
}  // namespace grove
