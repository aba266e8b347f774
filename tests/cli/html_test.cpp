#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/run_command.h"
#include "grove/base/error.h"
#include "grove/lab/page.h"

namespace grove::testing {
namespace {

using ::testing::HasSubstr;

bool has_pages() {
  try {
    check_page_available(PageKind::report);
    return true;
  } catch (const UsageError&) {
    return false;
  }
}

const std::vector<std::string> kQuickComparison{
    "compare", "builtin:cornell", "--structures", "bvh", "--rays", "random", "--count", "100", "--rounds", "1", "--html"};

std::vector<std::string> quick_comparison_to(const std::string& file) {
  std::vector<std::string> arguments = kQuickComparison;
  arguments.push_back(file);
  return arguments;
}

TEST(Html, ComparisonIsAPage) {
  if (!has_pages()) GTEST_SKIP() << "built without nodejs and npm";
  const TemporaryDirectory directory;
  const CommandResult result = run_command(directory, quick_comparison_to("report.html"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(directory.entry_count(), 1U) << "a temporary file is left";
  const std::string page = read_file(directory / "report.html");
  EXPECT_TRUE(page.starts_with("<!doctype html>"));
  EXPECT_THAT(page, HasSubstr("<title>Structures on builtin:cornell</title>"));
  EXPECT_THAT(page, HasSubstr("\"format\":\"grove-compare\""));
}

// Where the pages were not built the command says what is missing, with the code for a command that is wrong here.
TEST(Html, FailsBeforeTheWork) {
  const TemporaryDirectory directory;
  CommandSettings settings;
  settings.time_limit = 5.0;
  for (const std::vector<std::string>& verb :
       {std::vector<std::string>{"compare", "builtin:soup?triangles=20000000"}, std::vector<std::string>{"reproduce"}}) {
    std::vector<std::string> arguments = verb;
    arguments.insert(arguments.end(), {"--html", "/nowhere/file"});
    const CommandResult result = run_command(directory, arguments, settings);
    expect_failure(result, has_pages() ? 1 : 2);
    EXPECT_THAT(result.err, HasSubstr(has_pages() ? "/nowhere/file" : "install the packages nodejs"));
  }
}

}  // namespace
}  // namespace grove::testing
