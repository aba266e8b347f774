#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "cli/run_command.h"

namespace grove::testing {
namespace {

using ::testing::HasSubstr;

TEST(Help, OfTheProgramListsTheVerbs) {
  const TemporaryDirectory directory;
  const CommandResult result = run_command(directory, {"--help"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  for (const char* verb : {"render", "merge", "trace", "compare", "inspect", "animate", "structures"})
    EXPECT_THAT(result.out, HasSubstr(verb));
}

TEST(Help, OfEachVerbIsComplete) {
  const TemporaryDirectory directory;
  const std::map<std::string, std::vector<std::string>> options{
      {"render", {"SCENE",        "--output",      "--structure",     "--spp",        "--width",
                  "--height",     "--max-depth",   "--seed",          "--threads",    "--camera",
                  "--integrator", "--single-rays", "--exposure",      "--checkpoint", "--checkpoint-interval",
                  "--restart",    "--tile",        "--samples",       "--json",       "--quiet",
                  "--frames",     "--fps",         "--time",          "--animation",  "--loop",
                  "--update",     "--shutter",     "--shutter-times", "--resume",     "--eye",
                  "--look-at",    "--up",          "--fov",           "--sky"}},
      {"merge", {"FILMS", "--output", "--exposure", "--partial", "--threads", "--quiet"}},
      {"trace", {"SCENE", "--rays", "--hits", "--structure", "--query", "--threads", "--repeat", "--json", "--quiet"}},
      {"compare",
       {"SCENE", "--structures", "--rays", "--rounds", "--count", "--seed", "--camera", "--threads", "--json", "--csv", "--html",
        "--time-limit", "--memory-limit", "--matched-memory", "--scale", "--sizes", "--max", "--quiet"}},
      {"inspect", {"SCENE", "--structure", "--threads", "--json", "--html", "--camera", "--obj", "--depth", "--quiet"}},
      {"reproduce", {"--quick", "--only", "--list", "--json", "--html", "--markdown", "--restart", "--threads", "--quiet"}},
      {"structures", {"--json"}}};
  for (const auto& [verb, names] : options) {
    const CommandResult result = run_command(directory, {verb, "--help"});
    EXPECT_EQ(result.exit_code, 0) << verb;
    EXPECT_EQ(result.err, "") << verb;
    EXPECT_THAT(result.out, HasSubstr("Examples"));
    EXPECT_THAT(result.out, HasSubstr("  grove " + verb));
    for (const std::string& name : names) EXPECT_THAT(result.out, HasSubstr(name)) << verb;
  }
}

TEST(Version, IsPrinted) {
  const TemporaryDirectory directory;
  const CommandResult result = run_command(directory, {"--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, ::testing::MatchesRegex("grove [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

}  // namespace
}  // namespace grove::testing
