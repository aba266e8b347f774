// What the library's sources may not do, and where SIMD may live.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "architecture/source_tree.h"

namespace grove::architecture {
namespace {

// Printing, ending the process, making threads of its own and changing what is global are the calling program's business.
const std::regex& forbidden_call() {
  static const std::regex pattern(
      R"(\b(?:exit|_Exit|_exit|quick_exit|abort|terminate|printf|fprintf|vprintf|puts|fputs|putchar|perror|assert)\s*\()"
      R"(|\bstd::(?:cout|cerr|clog)\b|\b(?:stdout|stderr)\b|\bstd::(?:jthread|async)\b|\bstd::thread\s*[({\w]|\bglobal_control\b)"
      R"(|\bsetlocale\b|\bstd::locale::global\b)");
  return pattern;
}

// Aliases are declared by `using`.
const std::regex& old_alias() {
  static const std::regex pattern(R"(\btypedef\b)");
  return pattern;
}

// A header must not open a namespace for all who include it.
const std::regex& opened_namespace() {
  static const std::regex pattern(R"(^using\s+namespace\b)");
  return pattern;
}

// Numbers of the lines where a pattern is found.
std::vector<std::size_t> lines_with(const std::regex& pattern, const std::string& text) {
  std::vector<std::size_t> numbers;
  for (const Line& line : lines_of(without_comments_and_strings(text))) {
    if (std::regex_search(line.text, pattern)) numbers.push_back(line.number);
  }
  return numbers;
}

// Of the lines that do what the library may not.
std::vector<std::size_t> forbidden_lines(const std::string& text) {
  return lines_with(forbidden_call(), text);
}

TEST(Policy, LibraryNeverPrintsExitsOrMakesThreads) {
  for (const auto& file : files_below("src/grove", {".h", ".inc", ".cpp"})) {
    // A broken invariant is a bug, and the one thing that ends the process.
    if (file.lexically_relative(repository()) == "src/grove/base/check.cpp") continue;
    const std::string text = read(file);
    for (const std::size_t number : forbidden_lines(text)) {
      ADD_FAILURE() << place(file, number) << ": " << lines_of(text)[number - 1].text;
    }
  }
}

TEST(Policy, AliasesAreDeclaredByUsing) {
  for (const char* folder : {"src", "apps", "tests", "bench"}) {
    for (const auto& file : files_below(folder, {".h", ".inc", ".cpp"}))
      for (const std::size_t number : lines_with(old_alias(), read(file))) ADD_FAILURE() << place(file, number) << ": typedef";
  }
}

TEST(Policy, HeadersOpenNoNamespace) {
  for (const char* folder : {"src", "apps", "tests", "bench"}) {
    for (const auto& file : files_below(folder, {".h", ".inc"}))
      for (const std::size_t number : lines_with(opened_namespace(), read(file)))
        ADD_FAILURE() << place(file, number) << ": using namespace";
  }
}

TEST(Policy, HighwayStaysUnderTraverseSimd) {
  for (const auto& file : files_below("src", {".h", ".inc", ".cpp"})) {
    const std::string relative = file.lexically_relative(repository()).string();
    for (const std::string& include : includes_of(read(file))) {
      if (include.find("hwy/") == std::string::npos) continue;
      EXPECT_TRUE(relative.starts_with("src/grove/traverse/simd/")) << relative << " includes " << include;
    }
  }
}

TEST(Policy, HeadersAreGuarded) {
  for (const char* folder : {"src", "apps", "tests"}) {
    for (const auto& file : files_below(folder, {".h"})) {
      // Highway's re-included headers guard themselves once per target.
      if (file.filename().string().ends_with("-inl.h")) continue;
      EXPECT_THAT(read(file), testing::HasSubstr("#pragma once")) << place(file, 1);
    }
  }
}

// Files up to 400 lines; the ones over 250 are listed, for a look at whether they hold two ideas.
TEST(Policy, FilesHoldOneIdea) {
  constexpr std::size_t kAim = 250;
  constexpr std::size_t kLimit = 400;
  for (const char* folder : {"src", "apps", "tests"}) {
    for (const auto& file : files_below(folder, {".h", ".inc", ".cpp"})) {
      const std::size_t count = lines_of(read(file)).size();
      EXPECT_LE(count, kLimit) << place(file, count);
      if (count > kAim) GTEST_LOG_(INFO) << place(file, count) << " is longer than " << kAim << " lines";
    }
  }
}

TEST(PolicyCheck, FindsForbiddenCalls) {
  EXPECT_THAT(forbidden_lines("int a;\nstd::exit(1);\n"), testing::ElementsAre(2));
  EXPECT_THAT(forbidden_lines("std::cout << a;\nprintf (x);\nstd::abort();\n"), testing::ElementsAre(1, 2, 3));
  EXPECT_THAT(forbidden_lines("std::fputs(a, stderr);\nstd::jthread t;\nassert(a);\n"), testing::ElementsAre(1, 2, 3));
}

TEST(PolicyCheck, FindsOldAliasesAndOpenedNamespaces) {
  EXPECT_THAT(lines_with(old_alias(), "typedef int a;\nusing b = int;\n// typedef\n"), testing::ElementsAre(1));
  EXPECT_THAT(lines_with(opened_namespace(), "using std::min;\nusing namespace std;\n"), testing::ElementsAre(2));
}

TEST(PolicyCheck, LeavesOtherTextAlone) {
  EXPECT_THAT(forbidden_lines("// std::exit(1)\n/* abort(); */\nauto s = \"printf(\";\n"), testing::IsEmpty());
  EXPECT_THAT(forbidden_lines("std::snprintf(b, n, f);\nstatic_assert(a);\nGROVE_ASSERT(a);\non_exit_of(b);\n"), testing::IsEmpty());
  EXPECT_THAT(forbidden_lines("auto r = R\"(abort())\"; int n = 1'000; char c = '\"';\n"), testing::IsEmpty());
}

}  // namespace
}  // namespace grove::architecture
