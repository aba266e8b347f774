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
