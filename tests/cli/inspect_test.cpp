#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "cli/run_command.h"

namespace grove::testing {
namespace {

using ::testing::HasSubstr;

TEST(Inspect, ShowsFiguresAndHistograms) {
  const TemporaryDirectory directory;
  const CommandResult result =
      run_command(directory, {"inspect", "builtin:cornell", "--json", "i.json", "--obj", "boxes.obj", "--threads", "2"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, HasSubstr("leaves by number of references"));
  EXPECT_THAT(result.out, HasSubstr("###"));
  EXPECT_EQ(directory.entry_count(), 2U) << "a temporary file is left";

  const auto json = nlohmann::json::parse(read_file(directory / "i.json"));
  EXPECT_EQ(json.at("structure"), "bvh");
  EXPECT_EQ(json.at("threads"), 2);
  EXPECT_GT(json.at("primitives"), 0);
  EXPECT_EQ(json.at("references"), json.at("primitives"));
  EXPECT_EQ(json.at("nodes"), 2 * json.at("leaves").get<int>() - 1);
  EXPECT_GT(json.at("depth"), 0);
  EXPECT_GT(json.at("bytes"), 0);
  EXPECT_GT(json.at("build_seconds"), 0.0);
  EXPECT_GT(json.at("expected_cost"), 0.0);
  EXPECT_GT(json.at("end_point_overlap"), 0.0);
  EXPECT_GT(json.at("end_point_overlap_error"), 0.0);
  EXPECT_GT(json.at("sibling_overlap"), 0.0);
  EXPECT_EQ(json.at("duplication"), 1.0);
  EXPECT_THAT(result.out, HasSubstr("end-point overlap"));
  EXPECT_THAT(result.out, HasSubstr("sibling overlap"));

  const std::string boxes = read_file(directory / "boxes.obj");
  EXPECT_THAT(boxes, HasSubstr("\nv "));
  EXPECT_THAT(boxes, HasSubstr("\nl "));
}

// Brute force has no nodes, and is shown all the same.
TEST(Inspect, LeavesOutWhatAStructureHasNot) {
  const TemporaryDirectory directory;
  const CommandResult result = run_command(directory, {"inspect", "builtin:cornell", "--structure", "brute", "--json", "i.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, ::testing::Not(HasSubstr("overlap")));
  const auto json = nlohmann::json::parse(read_file(directory / "i.json"));
  for (const char* key : {"end_point_overlap", "end_point_overlap_error", "sibling_overlap", "duplication"})
    EXPECT_TRUE(json.at(key).is_null()) << key;
}

TEST(Inspect, TheTreeDoesNotDependOnTheThreads) {
  const TemporaryDirectory directory;
  for (const char* threads : {"1", "4"}) {
    EXPECT_EQ(run_command(directory, {"inspect", "builtin:rings", "--threads", threads, "--obj", std::string(threads) + ".obj"}).exit_code,
              0);
  }
  EXPECT_TRUE(read_file(directory / "1.obj") == read_file(directory / "4.obj"));
}

TEST(Inspect, BoxesCanBeLimitedToLevels) {
  const TemporaryDirectory directory;
  EXPECT_EQ(run_command(directory, {"inspect", "builtin:cornell", "--obj", "root.obj", "--depth", "0"}).exit_code, 0);
  const std::string boxes = read_file(directory / "root.obj");
  EXPECT_EQ(std::count(boxes.begin(), boxes.end(), 'v'), 8 + std::count(boxes.begin(), boxes.begin() + boxes.find('\n'), 'v'));
}

TEST(Inspect, WritesAPage) {
  const TemporaryDirectory directory;
  const CommandResult result = run_command(directory, {"inspect", "builtin:cornell", "--structure", "bvh; kdtree", "--html", "i.html"});
  if (result.exit_code == 2) {
    EXPECT_THAT(result.err, HasSubstr("nodejs"));
    GTEST_SKIP() << "built without pages";
  }
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("wrote i.html"));
  EXPECT_EQ(directory.entry_count(), 1U) << "a temporary file is left";
  const std::string page = read_file(directory / "i.html");
  EXPECT_THAT(page, HasSubstr("\"format\":\"grove-inspect\""));
  EXPECT_THAT(page, HasSubstr("<title>Structures over builtin:cornell</title>"));
  EXPECT_THAT(page, HasSubstr("\"structure\":\"kdtree\""));
}

TEST(Inspect, UnwritableOutputsFailBeforeTheWork) {
  const TemporaryDirectory directory;
  CommandSettings settings;
  settings.time_limit = 5.0;
  for (const char* option : {"--json", "--obj", "--html"}) {
    const CommandResult result = run_command(directory, {"inspect", "builtin:soup?triangles=20000000", option, "/nowhere/file"}, settings);
    if (std::string_view(option) == "--html" && result.exit_code == 2) continue;  // built without pages
    expect_failure(result, 1);
    EXPECT_THAT(result.err, HasSubstr("/nowhere/file"));
  }
}

}  // namespace
}  // namespace grove::testing
