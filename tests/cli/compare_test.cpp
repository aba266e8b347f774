#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
      run_command(directory, {"compare", "builtin:rings", "--rays", "primary", "--count", "20000", "--rounds", "1"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("note: brute is left out"));
  EXPECT_THAT(result.out, HasSubstr("note: brute force answered"));
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
