#include "grove/lab/comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "grove/base/error.h"
#include "lab/small_scene.h"

namespace grove {
namespace {

ComparisonSettings quick_settings() {
  ComparisonSettings settings;
  settings.structures = {"bvh", "brute"};
  settings.workload.ray_count = 500;
  settings.rounds = 2;
  return settings;
}

void expect_ordered(const Spread& spread) {
  EXPECT_GT(spread.min, 0.0);
  EXPECT_LE(spread.min, spread.median);
  EXPECT_LE(spread.median, spread.max);
}

TEST(Comparison, MeasuresEveryStructureOnEveryKindOfRays) {
  for (const Scene& scene : {testing::small_scene(), testing::instanced_scene()}) {
    const Comparison comparison = compare(scene, quick_settings());
    ASSERT_EQ(comparison.rows.size(), 8U);
    EXPECT_EQ(comparison.rounds, 2U);
    EXPECT_EQ(comparison.reference_rays, 500U);
    EXPECT_EQ(comparison.primitives, scene.primitive_count());
    for (std::size_t i = 0; i < comparison.rows.size(); ++i) {
      const ComparisonRow& row = comparison.rows[i];
      SCOPED_TRACE(row.structure + " " + std::string(name_of(row.rays)));
      EXPECT_EQ(row.rays, ray_kinds()[i / 2]);
      EXPECT_EQ(row.structure, i % 2 == 0 ? "bvh" : "brute");
      EXPECT_EQ(row.error, "");
      EXPECT_EQ(row.mismatches, 0U);
      EXPECT_GT(row.nodes_per_ray + row.tests_per_ray, 0.0);
      expect_ordered(row.mrays_per_s);
      expect_ordered(row.build_seconds);
      expect_ordered(row.ratio_to_first);
      EXPECT_EQ(row.end_point_overlap.has_value(), i % 2 == 0);
      EXPECT_EQ(row.sibling_overlap.has_value(), i % 2 == 0);
      EXPECT_GT(row.references, 0U);
      EXPECT_GT(row.nodes, 0U);
      EXPECT_EQ(row.end_point_overlap, comparison.rows[i % 2].end_point_overlap);
      if (i % 2 == 0) {
        EXPECT_EQ(row.ratio_to_first, (Spread{1.0, 1.0, 1.0}));
      } else {
        EXPECT_GE(row.tests_per_ray, comparison.rows[i - 1].tests_per_ray);
      }
    }
  }
}

TEST(Comparison, BruteForceTracesASampleWhereAllWouldTakeLong) {
  ComparisonSettings settings = quick_settings();
  settings.structures = {"brute", "bvh"};
  settings.rays = {RayKind::random};
  settings.workload.ray_count = 100'000;
  settings.rounds = 1;
  const Comparison comparison = compare(testing::small_scene(), settings);
  ASSERT_EQ(comparison.rows.size(), 2U);
  // 10 million tests of 212 primitives are 47,169 rays: every third.
  EXPECT_EQ(comparison.rows[0].ray_count, 33'334U);
  EXPECT_EQ(comparison.rows[1].ray_count, 100'000U);
  for (const ComparisonRow& row : comparison.rows) {
    EXPECT_EQ(row.error, "");
    EXPECT_EQ(row.mismatches, 0U);
    expect_ordered(row.mrays_per_s);
  }
  EXPECT_EQ(comparison.rows[0].tests_per_ray, 212.0);
}

TEST(Comparison, CountsAreTheSameEachTime) {
  const Scene scene = testing::small_scene();
  const Comparison first = compare(scene, quick_settings());
  const Comparison second = compare(scene, quick_settings());
  for (std::size_t i = 0; i < first.rows.size(); ++i) {
    EXPECT_EQ(first.rows[i].nodes_per_ray, second.rows[i].nodes_per_ray);
    EXPECT_EQ(first.rows[i].tests_per_ray, second.rows[i].tests_per_ray);
    EXPECT_EQ(first.rows[i].bytes, second.rows[i].bytes);
    EXPECT_EQ(first.rows[i].expected_cost, second.rows[i].expected_cost);
  }
}

TEST(Comparison, ReportsEachStep) {
  std::vector<std::uint64_t> steps;
  std::uint64_t total = 0;
  static_cast<void>(compare(testing::small_scene(), quick_settings(),
                            {[&](std::uint64_t done, std::uint64_t all) {
                               steps.push_back(done);
                               total = all;
                             },
                             {}}));
  // Four kinds of 500 rays: once for the reference; then, for two structures, in one check and two rounds.
  EXPECT_EQ(total, 4U * 500U * 7U);
  ASSERT_EQ(steps.size(), 28U);
  for (std::size_t i = 0; i < steps.size(); ++i) EXPECT_EQ(steps[i], 500U * (i + 1));
}

TEST(Comparison, StopsWhenAsked) {
  std::stop_source stop;
  const auto stop_after_checks = [&](std::uint64_t done, std::uint64_t) {
    if (done == 4U * 500U * 3U) stop.request_stop();
  };
  const Comparison comparison = compare(testing::small_scene(), quick_settings(), {stop_after_checks, stop.get_token()});
  EXPECT_EQ(comparison.rounds, 0U);
  EXPECT_EQ(comparison.rows.size(), 8U);
  EXPECT_GT(comparison.rows.front().tests_per_ray, 0.0);
}

TEST(Comparison, RefusesUnknownStructuresAndCameras) {
  const Scene scene = testing::small_scene();
  ComparisonSettings settings = quick_settings();
  settings.structures = {"oak"};
  EXPECT_THROW(static_cast<void>(compare(scene, settings)), UsageError);
  settings = quick_settings();
  settings.camera = "none such";
  EXPECT_THROW(static_cast<void>(compare(scene, settings)), UsageError);
}

TEST(DefaultSpecs, LeaveOutBruteForceOnlyWhereItIsSlow) {
  std::vector<std::string> notes;
  EXPECT_THAT(default_specs(10'000, notes), ::testing::Contains("brute"));
  EXPECT_THAT(notes, ::testing::IsEmpty());
  EXPECT_THAT(default_specs(10'001, notes), ::testing::Not(::testing::Contains("brute")));
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_THAT(notes.front(), ::testing::HasSubstr("brute"));
}

}  // namespace
}  // namespace grove
