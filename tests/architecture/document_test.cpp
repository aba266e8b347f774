// The documents tell the truth about the files they point at.

#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "architecture/source_tree.h"

namespace grove::architecture {
namespace {

std::vector<std::filesystem::path> documents() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(repository())) {
    if (entry.path().extension() == ".md") files.push_back(entry.path());
  }
  for (const char* folder : {"docs", "src", "apps", "tests", "bench", "examples"}) {
    for (const auto& file : files_below(folder, {".md"})) files.push_back(file);
  }
  return files;
}

// Targets of links and pictures that are neither addresses nor places within the page.
std::vector<std::string> local_links(const std::string& markdown) {
  static const std::regex link(R"(\]\(([^)#\s]+)(?:#[^)\s]*)?\))");
  std::vector<std::string> links;
  for (auto it = std::sregex_iterator(markdown.begin(), markdown.end(), link); it != std::sregex_iterator(); ++it) {
    const std::string target = (*it)[1];
    if (target.find("://") == std::string::npos) links.push_back(target);
  }
  return links;
}

TEST(Documents, LinkToFilesThatAreThere) {
  ASSERT_FALSE(documents().empty());
  for (const auto& file : documents()) {
    for (const std::string& link : local_links(read(file))) {
      EXPECT_TRUE(std::filesystem::exists(file.parent_path() / link)) << place(file, 1) << " links to " << link;
    }
  }
}

TEST(Documents, NameMakeTargetsThatAreThere) {
  const std::string makefile = read(repository() / "Makefile");
  static const std::regex command(R"(`make ([a-z]+)[^`]*`|^make ([a-z]+))", std::regex::multiline);
  int named = 0;
  for (const auto& file : documents()) {
    const std::string text = read(file);
    for (auto it = std::sregex_iterator(text.begin(), text.end(), command); it != std::sregex_iterator(); ++it) {
      const std::string target = (*it)[1].matched ? (*it)[1] : (*it)[2];
      EXPECT_NE(makefile.find("\n" + target + ":"), std::string::npos) << place(file, 1) << " names make " << target;
      ++named;
    }
  }
  EXPECT_GT(named, 0);
}

TEST(DocumentCheck, FindsLocalLinks) {
  const std::vector<std::string> expected{"docs/a.md", "b.png"};
  EXPECT_EQ(local_links("[a](docs/a.md#there) ![b](b.png) [c](https://example.org/c) [d](#d)"), expected);
}

}  // namespace
}  // namespace grove::architecture
