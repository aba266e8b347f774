#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/run_command.h"

namespace grove::testing {
namespace {

using ::testing::HasSubstr;

TEST(Animate, PrintsATableAndWritesJsonAndCsv) {
  const TemporaryDirectory directory;
  const CommandResult result = run_command(directory, {"animate", "builtin:twist?size=3", "--frames", "3", "--count", "500", "--update",
                                                       "auto, refit", "--rays", "random", "--json", "a.json", "--csv", "a.csv"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("cost growth"));
  EXPECT_EQ(nlohmann::json::parse(read_file(directory / "a.json")).at("rows").size(), 6U);
  EXPECT_EQ(line_count(read_file(directory / "a.csv")), 7U);
  EXPECT_EQ(directory.entry_count(), 2U) << "a temporary file is left";
}

TEST(Animate, WrongRequestsAreSaidInOneLine) {
  const TemporaryDirectory directory;
  const CommandResult still = run_command(directory, {"animate", "builtin:tree"});
  expect_failure(still, 2);
  EXPECT_THAT(still.err, HasSubstr("builtin:shatter, builtin:twist"));
  const CommandResult way = run_command(directory, {"animate", "builtin:twist", "--update", "guess"});
  expect_failure(way, 2);
  EXPECT_THAT(way.err, HasSubstr("auto, refit, rotate, rebuild"));
}

}  // namespace
}  // namespace grove::testing
