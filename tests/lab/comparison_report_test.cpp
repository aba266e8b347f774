#include "grove/lab/comparison_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

namespace grove {
namespace {

using ::testing::HasSubstr;

Comparison two_rows() {
  Comparison comparison;
  comparison.scene = "a \"scene\", of sorts";
  comparison.primitives = 1234;
  comparison.ray_count = 1000;
  comparison.rounds = 3;
  comparison.reference_rays = 1000;
  comparison.machine = {"a processor", 8, 2, "a compiler", "abc", "a system"};
  ComparisonRow good;
  good.structure = "bvh";
  good.ray_count = 1000;
  good.mrays_per_s = {2.0, 1.0, 3.0};
  good.ratio_to_first = {1.0, 1.0, 1.0};
  good.rays = "primary";
  good.work = {{12.5, 20, 33}, {3.25, 6, 9}, {{8, 400}, {12, 600}}};
  good.is_described = good.is_counted = true;
  good.build_seconds = {0.5, 0.25, 0.75};
  good.build_seconds_one_thread = {1.0, 0.75, 1.25};
  good.duplication = 1.0625;
  good.bytes = 2048;
  good.expected_cost = 40.0;
  good.references = 1300;
  good.nodes = 99;
  good.leaves = 50;
  good.depth = 7;
  good.end_point_overlap = 0.5;
  ComparisonRow bad;
  bad.structure = "brute";
  bad.rays = "primary";
  bad.ray_count = 10;
  bad.error = "out of memory";
  comparison.rows = {good, bad};
  comparison.notes = {"something was left out"};
  return comparison;
}

TEST(ComparisonReport, JsonHasTheAgreedKeys) {
  const nlohmann::ordered_json json = comparison_json(two_rows());
  EXPECT_EQ(json.at("format"), "grove-compare");
  EXPECT_EQ(json.at("version"), 1);
  EXPECT_EQ(json.at("scene"), "a \"scene\", of sorts");
  for (const char* key : {"cpu", "cores", "threads", "compiler", "commit", "os"}) EXPECT_TRUE(json.at("machine").contains(key)) << key;
  ASSERT_EQ(json.at("rows").size(), 2U);
  const auto& row = json.at("rows").at(0);
  EXPECT_EQ(row.at("structure"), "bvh");
  EXPECT_EQ(row.at("rays"), "primary");
  EXPECT_EQ(row.at("mrays_per_s"), (nlohmann::ordered_json{{"median", 2.0}, {"min", 1.0}, {"max", 3.0}}));
  EXPECT_EQ(row.at("build_seconds").at("max"), 0.75);
  EXPECT_EQ(row.at("nodes_per_ray"), 12.5);
  EXPECT_EQ(row.at("tests_per_ray"), 3.25);
  EXPECT_EQ(row.at("bytes"), 2048);
  EXPECT_EQ(row.at("expected_cost"), 40.0);
  EXPECT_EQ(row.at("end_point_overlap"), 0.5);
  EXPECT_TRUE(row.at("sibling_overlap").is_null());
  EXPECT_EQ(row.at("references"), 1300);
  EXPECT_EQ(row.at("duplication"), 1.0625);
  EXPECT_EQ(row.at("build_seconds_one_thread").at("median"), 1.0);
  EXPECT_EQ(row.at("work").at("nodes"), (nlohmann::ordered_json{{"mean", 12.5}, {"p95", 20}, {"max", 33}}));
  EXPECT_EQ(row.at("work").at("tests").at("p95"), 6);
  EXPECT_EQ(row.at("steps_histogram"), nlohmann::ordered_json::parse("[[8, 400], [12, 600]]"));
  EXPECT_EQ(row.at("nodes"), 99);
  EXPECT_EQ(row.at("leaves"), 50);
  EXPECT_EQ(row.at("depth"), 7);
  EXPECT_EQ(row.at("mismatches"), 0);
  EXPECT_FALSE(row.contains("error"));
}

TEST(ComparisonReport, AFailedRowSaysWhyAndHasNoFigures) {
  const auto row = comparison_json(two_rows()).at("rows").at(1);
  EXPECT_EQ(row.at("error"), "out of memory");
  for (const char* key : {"mrays_per_s", "nodes_per_ray", "build_seconds", "bytes", "mismatches", "end_point_overlap", "references",
                          "depth", "work", "steps_histogram", "build_seconds_one_thread"})
    EXPECT_TRUE(row.at(key).is_null()) << key;
  EXPECT_THAT(comparison_table(two_rows()), HasSubstr("failed: brute on primary rays: out of memory"));
}

TEST(ComparisonReport, TableLinesUp) {
  const std::string table = comparison_table(two_rows());
  EXPECT_THAT(table, HasSubstr("2.00 (1.00–3.00)"));
  EXPECT_THAT(table, HasSubstr("  40.0  0.500        -\n"));
  EXPECT_THAT(table, HasSubstr("note: something was left out"));
  EXPECT_THAT(table, ::testing::Not(HasSubstr(" \n")));
}

TEST(ComparisonReport, CsvQuotesWhatNeedsIt) {
  const std::string csv = comparison_csv(two_rows());
  std::istringstream lines(csv);
  std::string heading;
  std::string good;
  std::string bad;
  std::getline(lines, heading);
  std::getline(lines, good);
  std::getline(lines, bad);
  EXPECT_EQ(good,
            "\"a \"\"scene\"\", of "
            "sorts\",primary,bvh,1000,2,1,3,1,12.5,20,33,3.25,6,9,0.5,0.25,0.75,1,0.75,1.25,2048,40,0.5,,1300,1.0625,99,50,7,0,");
  EXPECT_EQ(bad, "\"a \"\"scene\"\", of sorts\",primary,brute,10,,,,,,,,,,,,,,,,,,,,,,,,,,,out of memory");
  EXPECT_EQ(std::count(heading.begin(), heading.end(), ','), 30);
}

TEST(ComparisonReport, SaysWhenOnlyASampleWasChecked) {
  Comparison comparison = two_rows();
  EXPECT_THAT(comparison_table(comparison), ::testing::Not(HasSubstr("brute force answered")));
  comparison.reference_rays = 10;
  EXPECT_THAT(comparison_table(comparison), HasSubstr("brute force answered 10 of the 1,000 rays"));
}

}  // namespace
}  // namespace grove
