// Every `grove VERB` that the documents show is a verb of the command.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <regex>
#include <set>
#include <string>

#include "architecture/source_tree.h"

namespace grove::architecture {
namespace {

#ifdef GROVE_COMMAND
int exit_code_of(const std::string& arguments) {
  const int status = std::system(("\"" GROVE_COMMAND "\" " + arguments + " >/dev/null 2>&1").c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// Verbs in lines such as "build/release/bin/grove render …" or "`grove inspect …`".
std::set<std::string> verbs_in(const std::string& markdown) {
  static const std::regex command(R"((?:^|`|bin/)grove ([a-z]+)\b)", std::regex::multiline);
  std::set<std::string> verbs;
  for (auto it = std::sregex_iterator(markdown.begin(), markdown.end(), command); it != std::sregex_iterator(); ++it) {
    verbs.insert((*it)[1]);
  }
  return verbs;
}

TEST(Command, HasEveryVerbThatTheReadmeShows) {
  const std::set<std::string> verbs = verbs_in(read(repository() / "README.md"));
  ASSERT_TRUE(verbs.contains("render"));
  for (const std::string& verb : verbs) EXPECT_EQ(exit_code_of(verb + " --help"), 0) << "grove " << verb;
}

TEST(CommandCheck, FailsOnAVerbThatIsNotThere) {
  EXPECT_EQ(exit_code_of("nonsense --help"), 2);
}

TEST(CommandCheck, FindsVerbs) {
  EXPECT_EQ(verbs_in("build/release/bin/grove render a\nand `grove trace b`; the grove is green\n"),
            (std::set<std::string>{"render", "trace"}));
}
#endif

}  // namespace
}  // namespace grove::architecture
