#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/run_command.h"

namespace grove::testing {
namespace {

using ::testing::HasSubstr;

TEST(Compare, PrintsATableAndWritesJsonAndCsv) {
  const TemporaryDirectory directory;
  const CommandResult result = run_command(directory, {"compare", "builtin:cornell", "--structures", "bvh; bvh:leaf-size=2;brute",
                                                       "--count", "500", "--rounds", "2", "--json", "c.json", "--csv", "c.csv"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, HasSubstr("bvh:leaf-size=2"));
  EXPECT_EQ(directory.entry_count(), 2U) << "a temporary file is left";

  const auto json = nlohmann::json::parse(read_file(directory / "c.json"));
  EXPECT_EQ(json.at("scene"), "builtin:cornell");
  for (const char* key : {"cpu", "cores", "threads", "compiler", "os"}) EXPECT_TRUE(json.at("machine").contains(key)) << key;
  ASSERT_EQ(json.at("rows").size(), 12U);
  std::set<std::string> kinds;
  for (const auto& row : json.at("rows")) {
    kinds.insert(row.at("rays"));
    EXPECT_EQ(row.at("mismatches"), 0);
    EXPECT_GT(row.at("mrays_per_s").at("median"), 0.0);
    EXPECT_GT(row.at("build_seconds").at("median"), 0.0);
    for (const char* key : {"nodes_per_ray", "tests_per_ray", "bytes", "expected_cost", "references", "nodes", "leaves", "depth"})
      EXPECT_TRUE(row.at(key).is_number()) << key;
  }
  EXPECT_GT(json.at("rows").at(0).at("end_point_overlap"), 0.0);
  EXPECT_GT(json.at("rows").at(0).at("sibling_overlap"), 0.0);
  EXPECT_TRUE(json.at("rows").at(2).at("end_point_overlap").is_null()) << "brute force has no nodes";
  EXPECT_THAT(kinds, ::testing::ElementsAre("diffuse", "primary", "random", "shadow"));
  EXPECT_EQ(line_count(read_file(directory / "c.csv")), 13U);
}

TEST(Compare, EndsWithAdviceAndWritesWhatItRestsOn) {
  const TemporaryDirectory directory;
  const CommandResult result =
      run_command(directory, {"compare", "builtin:cornell", "--structures", "bvh;fast", "--rays", "primary,diffuse", "--count", "500",
                              "--rounds", "2", "--matched-memory", "--json", "c.json", "--quiet"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(read_file(directory / "c.json"));
  EXPECT_EQ(json.at("format"), "grove-compare");
  EXPECT_THAT(json.at("command"), HasSubstr("grove compare builtin:cornell --structures 'bvh;fast'"));
  ASSERT_EQ(json.at("advice").size(), 5U);
  for (const auto& one : json.at("advice")) {
    EXPECT_THAT(result.out, HasSubstr("  " + one.at("use").get<std::string>() + ": " + one.at("structure").get<std::string>()));
    EXPECT_THAT(result.out, HasSubstr(one.at("why").get<std::string>()));
  }
  ASSERT_EQ(json.at("break_even").size(), 2U);
  EXPECT_EQ(json.at("break_even").at(0).at("curves").size(), 2U);
  EXPECT_EQ(json.at("break_even").at(0).at("best").at(0).at("from_rays"), 0.0);
  EXPECT_EQ(json.at("heat_maps").at("maps").size(), 2U);
  EXPECT_EQ(json.at("heat_maps").at("maps").at(0).at("steps").get<std::string>().size(), 320U * 180U * 2U / 3U * 4U);
  EXPECT_EQ(json.at("matched_memory").at("table").at("rows").size(), 2U);
  EXPECT_TRUE(json.at("predictions").is_array());
  EXPECT_THAT(json.at("auto").at("reason"), HasSubstr("triangles"));
}

TEST(Compare, TracesTheKindsOfRaysAskedFor) {
  const TemporaryDirectory directory;
  const CommandResult result = run_command(
      directory, {"compare", "builtin:cornell", "--rays", "random", "--count", "100", "--rounds", "1", "--threads", "1", "--quiet"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("random"));
  EXPECT_THAT(result.out, ::testing::Not(HasSubstr("shadow")));
}

TEST(Compare, LeavesBruteForceOutOfLargeScenesAndSaysSo) {
  const TemporaryDirectory directory;
  const CommandResult result =
      run_command(directory, {"compare", "builtin:rings?size=2&detail=10", "--rays", "primary", "--count", "2000", "--rounds", "1"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("note: brute is left out"));
  EXPECT_THAT(result.out, HasSubstr("note: brute force answered"));
}

TEST(Compare, AStructureOverALimitIsARowThatSaysSo) {
  const TemporaryDirectory directory;
  const std::vector<std::string> common{"compare",      "builtin:soup?triangles=100000",
                                        "--structures", "kdtree;bvh",
                                        "--rays",       "random",
                                        "--count",      "200",
                                        "--rounds",     "1",
                                        "--quiet",      "--json",
                                        "c.json"};
  // A kd-tree over long thin triangles takes ten times the memory of a hierarchy while it is built, and fifty times the time.
  const std::vector<std::pair<std::vector<std::string>, const char*>> limits{
      {{"--memory-limit", "20M"}, "memory than the limit of 20.0 MiB"}, {{"--time-limit", "0.001"}, "time limit of 0.001 s"}};
  for (const auto& [limit, reason] : limits) {
    std::vector<std::string> arguments = common;
    arguments.insert(arguments.end(), limit.begin(), limit.end());
    const CommandResult result = run_command(directory, arguments);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.out, HasSubstr(std::string("failed: kdtree on random rays: building takes ")));
    EXPECT_THAT(result.out, HasSubstr(reason));
    const auto json = nlohmann::json::parse(read_file(directory / "c.json"));
    ASSERT_EQ(json.at("rows").size(), 2U);
    EXPECT_THAT(json.at("rows").at(0).at("error"), HasSubstr(reason));
    EXPECT_TRUE(json.at("rows").at(0).at("bytes").is_null());
    EXPECT_EQ(json.at("complete"), true);
    EXPECT_EQ(json.at("rows").at(1).contains("error"), limit.front() == "--time-limit");
  }
}

TEST(Compare, LimitsThatAreKeptChangeNothing) {
  const TemporaryDirectory directory;
  const CommandResult result = run_command(directory, {"compare", "builtin:cornell", "--structures", "bvh;fast", "--rays", "primary",
                                                       "--count", "200", "--rounds", "1", "--memory-limit", "1GiB", "--time-limit", "50"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, ::testing::Not(HasSubstr("failed")));
}

TEST(Compare, InterruptedLeavesTheFinishedRowsInAValidFile) {
  const TemporaryDirectory directory;
  CommandSettings settings;
  settings.signal = SIGINT;
  settings.signal_when_file = "c.json";
  const CommandResult result = run_command(directory,
                                           {"compare", "builtin:cornell", "--structures", "bvh;fast", "--rays", "primary", "--count", "200",
                                            "--rounds", "10000", "--json", "c.json", "--csv", "c.csv", "--quiet"},
                                           settings);
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_THAT(result.err, HasSubstr("interrupted"));
  const auto json = nlohmann::json::parse(read_file(directory / "c.json"));
  EXPECT_EQ(json.at("complete"), false);
  ASSERT_EQ(json.at("rows").size(), 2U);
  for (const auto& row : json.at("rows")) EXPECT_GT(row.at("tests_per_ray"), 0.0);
  EXPECT_EQ(line_count(read_file(directory / "c.csv")), 3U);
  EXPECT_EQ(directory.entry_count(), 2U) << "a temporary file is left";
}

TEST(Compare, AFullDiskLeavesTheFinishedRowsInAValidFile) {
  const TemporaryDirectory directory;
  CommandSettings settings;
  settings.file_limit = 300'000;  // two heat maps fit, three do not
  const CommandResult result = run_command(directory,
                                           {"compare", "builtin:cornell", "--structures", "bvh;fast;kdtree", "--rays", "primary", "--count",
                                            "200", "--rounds", "1", "--json", "c.json", "--quiet"},
                                           settings);
  expect_failure(result, 1);
  EXPECT_THAT(result.err, HasSubstr("c.json: cannot be written"));
  EXPECT_THAT(result.out, HasSubstr("kdtree")) << "the table comes all the same";
  const auto json = nlohmann::json::parse(read_file(directory / "c.json"));
  EXPECT_EQ(json.at("complete"), false);
  EXPECT_EQ(json.at("rows").size(), 1U);
  EXPECT_EQ(directory.entry_count(), 1U) << "a temporary file is left";
}

TEST(Compare, RecordsTheRaysOfAPathTracedPicture) {
  const TemporaryDirectory directory;
  const CommandResult result = run_command(directory, {"compare", "builtin:cornell", "--structures", "bvh", "--rays", "recorded", "--count",
                                                       "2000", "--rounds", "1", "--quiet"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* kind : {"recorded ", "recorded-0 ", "recorded-1 "}) EXPECT_THAT(result.out, HasSubstr(kind));
}

TEST(Compare, UnwritableOutputsFailBeforeTheWork) {
  const TemporaryDirectory directory;
  CommandSettings settings;
  settings.time_limit = 5.0;
  for (const char* option : {"--json", "--csv"}) {
    const CommandResult result = run_command(directory, {"compare", "builtin:soup?triangles=20000000", option, "/nowhere/file"}, settings);
    expect_failure(result, 1);
    EXPECT_THAT(result.err, HasSubstr("/nowhere/file"));
  }
}

}  // namespace
}  // namespace grove::testing
