#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "cli/run_command.h"

namespace grove::testing {
namespace {

using ::testing::HasSubstr;

TEST(Reproduce, ChecksTheClaimsAskedFor) {
  const TemporaryDirectory directory;
  const std::vector<std::string> arguments{"reproduce", "--quick", "--only", "octree-deep-and-empty", "--markdown", "f.md"};
  const CommandResult result = run_command(directory, arguments);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("octree-deep-and-empty (III.A.3"));
  EXPECT_THAT(result.out, HasSubstr("1 claim: 1 holds"));
  const auto json = nlohmann::json::parse(read_file(directory / "reproduce-quick.json"));
  ASSERT_EQ(json.at("claims").size(), 1U);
  EXPECT_EQ(json.at("claims").at(0).at("verdict"), "holds");
  EXPECT_THAT(read_file(directory / "f.md"), HasSubstr("### octree-deep-and-empty"));
  EXPECT_EQ(directory.entry_count(), 2U) << "a temporary file is left";

  EXPECT_THAT(run_command(directory, arguments).out, HasSubstr("only the others are checked"));
}

TEST(Reproduce, ListsTheClaims) {
  const TemporaryDirectory directory;
  const CommandResult result = run_command(directory, {"reproduce", "--list"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("octree-r-gain"));
  EXPECT_EQ(directory.entry_count(), 0U);
}

TEST(Reproduce, KeepsWhatIsFinishedWhenInterrupted) {
  const TemporaryDirectory directory;
  CommandSettings settings;
  settings.signal = SIGINT;
  settings.signal_when = "octree-one-parent";
  const CommandResult result = run_command(directory, {"reproduce", "--quick", "--only", "octree-one-parent,octree-r-gain"}, settings);
  EXPECT_EQ(result.exit_code, 130);
  const auto json = nlohmann::json::parse(read_file(directory / "reproduce-quick.json"));
  EXPECT_EQ(json.at("complete"), false);
  EXPECT_THAT(result.err, HasSubstr("the same command goes on"));
}

TEST(Reproduce, RefusesWhatIsNotItsOwn) {
  const TemporaryDirectory directory;
  write_file(directory / "other.json", "[1, 2]");
  expect_failure(run_command(directory, {"reproduce", "--quick", "--json", "other.json"}), 1);
  EXPECT_EQ(read_file(directory / "other.json"), "[1, 2]") << "a file that is not its own is left alone";
  expect_failure(run_command(directory, {"reproduce", "--only", "earth-is-flat"}), 2);
}

}  // namespace
}  // namespace grove::testing
