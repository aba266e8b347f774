#include "grove/lab/page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "grove/base/error.h"

namespace grove {
namespace {

using nlohmann::ordered_json;
using ::testing::HasSubstr;
using ::testing::Not;

/// Whether this build has the pages; without them it must say so.
bool has_pages() {
  try {
    check_page_available(PageKind::report);
    return true;
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("nodejs"));
    EXPECT_THAT(error.what(), HasSubstr("npm"));
    return false;
  }
}

/// The text of the script element that holds the data.
std::string data_text(const std::string& page) {
  const std::string open = "<script id=\"grove-data\" type=\"application/json\">";
  const std::size_t first = page.find(open);
  if (first == std::string::npos) return "";
  const std::size_t begin = first + open.size();
  return page.substr(begin, page.find("</script>", begin) - begin);
}

TEST(Page, HoldsTheDataAsTheyAre) {
  if (!has_pages()) GTEST_SKIP() << "built without nodejs and npm";
  const ordered_json data{{"format", "grove-compare"}, {"scene", "a \"b\" \\ </script><!-- ü"}, {"rows", {1, 2.5, nullptr}}};
  const std::string page = html_page(PageKind::report, "A title", data);
  EXPECT_THAT(data_text(page), Not(HasSubstr("<"))) << "the element would end there";
  EXPECT_EQ(ordered_json::parse(data_text(page)), data);
}

TEST(Page, EscapesTheTitle) {
  if (!has_pages()) GTEST_SKIP() << "built without nodejs and npm";
  const std::string page = html_page(PageKind::report, "a.glb?x=1&y=<b>", {});
  EXPECT_THAT(page, HasSubstr("<title>a.glb?x=1&amp;y=&lt;b></title>"));
}

TEST(Page, ReplacesTextThatIsNotUtf8) {
  if (!has_pages()) GTEST_SKIP() << "built without nodejs and npm";
  const std::string page = html_page(PageKind::report, "", {{"scene", "caf\xe9.obj"}});
  EXPECT_EQ(ordered_json::parse(data_text(page)).at("scene"), "caf\xef\xbf\xbd.obj");
}

TEST(Page, AsksForNothingElse) {
  if (!has_pages()) GTEST_SKIP() << "built without nodejs and npm";
  const std::string page = html_page(PageKind::report, "", {});
  EXPECT_THAT(page, Not(HasSubstr("<script src")));
  EXPECT_THAT(page, Not(HasSubstr("<link rel=\"stylesheet\"")));
  EXPECT_THAT(page, Not(HasSubstr("@GROVE_")));
}

}  // namespace
}  // namespace grove
