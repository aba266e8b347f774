#include "grove/lab/structure_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace grove {
namespace {

using ::testing::HasSubstr;

TEST(StructureReport, JsonHasTheAgreedKeys) {
  StructureStatistics statistics;
  statistics.primitives = 10;
  statistics.references = 11;
  statistics.nodes = 5;
  statistics.leaves = 3;
  statistics.depth = 2;
  statistics.bytes = 160;
  statistics.build_seconds = 0.5;
  statistics.expected_cost = 7.5;
  const auto json = structure_json("bvh", statistics, 4);
  EXPECT_EQ(json.at("structure"), "bvh");
  EXPECT_EQ(json.at("primitives"), 10);
  EXPECT_EQ(json.at("references"), 11);
  EXPECT_EQ(json.at("nodes"), 5);
  EXPECT_EQ(json.at("leaves"), 3);
  EXPECT_EQ(json.at("depth"), 2);
  EXPECT_EQ(json.at("bytes"), 160);
  EXPECT_EQ(json.at("build_seconds"), 0.5);
  EXPECT_EQ(json.at("expected_cost"), 7.5);
  EXPECT_EQ(json.at("threads"), 4);
}

TEST(StructureReport, SaysHowLeavesAreFilledAndHowDeepTheyLie) {
  StructureStatistics statistics;
  statistics.references = 30;
  statistics.leaves = 4;
  statistics.largest_leaf = 12;
  statistics.depth = 3;
  statistics.depths = {0, 1, 1, 2};
  const auto json = structure_json("bvh", statistics, 1);
  EXPECT_EQ(json.at("mean_leaf_size"), 7.5);
  EXPECT_EQ(json.at("largest_leaf"), 12);
  EXPECT_EQ(json.at("mean_leaf_depth"), 2.25);
  const std::string text = structure_text("bvh", statistics, {}, std::nullopt, 1);
  EXPECT_THAT(text, HasSubstr("4  (7.50 references on average, 12 at most)"));
  EXPECT_THAT(text, HasSubstr("3  (2.25 on average over leaves)"));
}

TEST(StructureReport, QualityIsNullWhereItWasNotMeasured) {
  StructureQuality quality;
  const auto nothing = quality_json(quality);
  EXPECT_EQ(nothing.size(), 5U);
  for (const auto& [key, value] : nothing.items()) EXPECT_TRUE(value.is_null()) << key;
  EXPECT_THAT(structure_text("bvh", {}, quality, std::nullopt, 1),
              ::testing::Not(::testing::AnyOf(HasSubstr("overlap"), HasSubstr("clustering"))));
  quality.end_point_overlap = {.value = 0.5, .error = 0.01, .sample_count = 1000};
  quality.sibling_overlap = 0.25;
  quality.duplication = 1.5;
  const auto json = quality_json(quality);
  EXPECT_EQ(json.at("end_point_overlap"), 0.5);
  EXPECT_EQ(json.at("end_point_overlap_error"), 0.01);
  EXPECT_EQ(json.at("end_point_overlap_samples"), 1000);
  EXPECT_EQ(json.at("sibling_overlap"), 0.25);
  EXPECT_EQ(json.at("duplication"), 1.5);
  const std::string text = structure_text("bvh", {}, quality, 0.75, 1);
  EXPECT_THAT(text, HasSubstr("end-point overlap  0.500  (standard error 0.0100, 1,000 points)\n"));
  EXPECT_THAT(text, HasSubstr("sibling overlap    0.250\n"));
  EXPECT_THAT(text, HasSubstr("duplication        1.50\n"));
  EXPECT_THAT(text, HasSubstr("clustering         0.750  ("));
}

TEST(Histogram, DrawsABarForEachBin) {
  const std::vector<std::uint64_t> bins{0, 1, 100, 0, 50};
  const std::string text = histogram_text(bins, true);
  EXPECT_THAT(text, HasSubstr("   1  #   "));
  EXPECT_THAT(text, HasSubstr("   2  " + std::string(40, '#')));
  EXPECT_THAT(text, HasSubstr("  4+  " + std::string(20, '#') + " "));
  EXPECT_THAT(text, HasSubstr("66.2 %"));
}

TEST(Histogram, DrawsManyBinsTogether) {
  const std::string text = histogram_text(std::vector<std::uint64_t>(100, 1), false);
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 24);
  EXPECT_THAT(text, HasSubstr("0-4"));
  EXPECT_THAT(text, HasSubstr("95-99"));
}

TEST(Histogram, OfNothingSaysSo) {
  EXPECT_EQ(histogram_text({}, false), "  none\n");
  EXPECT_EQ(histogram_text(std::vector<std::uint64_t>(3, 0), true), "  none\n");
}

}  // namespace
}  // namespace grove
