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
      SCOPED_TRACE(row.structure + " " + row.rays);
      EXPECT_EQ(row.rays, name_of(ray_kinds()[i / 2]));
      EXPECT_EQ(row.structure, i % 2 == 0 ? "bvh" : "brute");
      EXPECT_EQ(row.error, "");
      EXPECT_EQ(row.mismatches, 0U);
      EXPECT_GT(row.nodes_per_ray() + row.tests_per_ray(), 0.0);
      EXPECT_LE(row.tests_per_ray(), static_cast<double>(row.work.tests.max));
      EXPECT_LE(row.work.tests.p95, row.work.tests.max);
      expect_ordered(row.build_seconds_one_thread);
      ASSERT_TRUE(row.update.has_value());
      EXPECT_EQ(row.update->method, i % 2 == 0 ? UpdateMethod::refit : UpdateMethod::rebuild);
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
        EXPECT_GE(row.tests_per_ray(), comparison.rows[i - 1].tests_per_ray());
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
  EXPECT_EQ(comparison.rows[0].tests_per_ray(), 212.0);
}

TEST(Comparison, CountsAreTheSameEachTime) {
  const Scene scene = testing::small_scene();
  const Comparison first = compare(scene, quick_settings());
  const Comparison second = compare(scene, quick_settings());
  for (std::size_t i = 0; i < first.rows.size(); ++i) {
    EXPECT_EQ(first.rows[i].nodes_per_ray(), second.rows[i].nodes_per_ray());
    EXPECT_EQ(first.rows[i].tests_per_ray(), second.rows[i].tests_per_ray());
    EXPECT_EQ(first.rows[i].bytes, second.rows[i].bytes);
    EXPECT_EQ(first.rows[i].expected_cost, second.rows[i].expected_cost);
  }
}

TEST(Comparison, TracesRecordedRaysAltogetherAndByBounce) {
  ComparisonSettings settings = quick_settings();
  settings.rays = {RayKind::recorded};
  const Comparison comparison = compare(testing::small_scene(), settings);
  ASSERT_GE(comparison.rows.size(), 6U);
  EXPECT_EQ(comparison.rows[0].rays, "recorded");
  EXPECT_EQ(comparison.rows[2].rays, "recorded-0");
  EXPECT_EQ(comparison.rows[4].rays, "recorded-1");
  std::size_t of_bounces = 0;
  for (const ComparisonRow& row : comparison.rows) {
    EXPECT_EQ(row.error, "");
    EXPECT_EQ(row.mismatches, 0U);
    expect_ordered(row.mrays_per_s);
    if (row.structure == "bvh" && row.rays != "recorded") of_bounces += row.ray_count;
  }
  EXPECT_EQ(of_bounces, comparison.rows[0].ray_count);
}

TEST(Comparison, SavesWhatIsFinished) {
  std::vector<Comparison> saved;
  const Comparison last = compare(testing::small_scene(), quick_settings(), {}, [&](const Comparison& so_far) { saved.push_back(so_far); });
  ASSERT_EQ(saved.size(), 3U) << "after each of two checks, and after the first of two rounds";
  EXPECT_EQ(saved[0].rows.size(), 4U);
  EXPECT_FALSE(saved[0].rows.front().is_timed());
  EXPECT_EQ(saved[1].rows.size(), 8U);
  EXPECT_TRUE(saved[2].rows.front().is_timed());
  for (const Comparison& one : saved) EXPECT_FALSE(one.is_complete);
  EXPECT_TRUE(last.is_complete);
}

TEST(Comparison, AStructureThatMayNotBeBuiltHasRowsThatSayWhy) {
  ComparisonSettings settings = quick_settings();
  settings.trial_build = [](const std::string& spec) { return spec == "bvh" ? std::string("too large") : std::string(); };
  const Comparison comparison = compare(testing::small_scene(), settings);
  ASSERT_EQ(comparison.rows.size(), 8U);
  for (const ComparisonRow& row : comparison.rows) {
    EXPECT_EQ(row.error, row.structure == "bvh" ? "too large" : "");
    EXPECT_EQ(row.is_timed(), row.structure == "brute");
  }
}

TEST(Comparison, TracingOverTheTimeLimitMakesARowThatSaysSo) {
  ComparisonSettings settings = quick_settings();
  settings.structures = {"bvh"};
  settings.workload.ray_count = 100'000;
  settings.rays = {RayKind::random};
  settings.time_limit = 1e-9;
  const Comparison comparison = compare(testing::small_scene(), settings);
  ASSERT_EQ(comparison.rows.size(), 1U);
  EXPECT_THAT(comparison.rows.front().error, ::testing::HasSubstr("time limit"));
}

TEST(Comparison, DrawsHeatMapsWhenAsked) {
  ComparisonSettings settings = quick_settings();
  settings.heat_maps = true;
  settings.rays = {RayKind::random};
  const Comparison comparison = compare(testing::small_scene(), settings);
  ASSERT_EQ(comparison.heat_maps.size(), 2U);
  EXPECT_EQ(comparison.heat_maps[0].structure, "bvh");
  EXPECT_EQ(comparison.heat_maps[0].steps.size(), std::size_t{kHeatMapWidth} * kHeatMapHeight);
  EXPECT_EQ(comparison.heat_maps[1].max, 212U) << "brute force tests every triangle";
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
  EXPECT_GT(comparison.rows.front().tests_per_ray(), 0.0);
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
