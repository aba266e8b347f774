#include "grove/lab/page.h"

#include <nlohmann/json.hpp>
#include <string_view>

#include "grove/base/check.h"
#include "grove/base/error.h"
#include "grove/lab/embedded_pages.h"

namespace grove {
namespace {

constexpr std::string_view kTitleMark = "@GROVE_TITLE@";
constexpr std::string_view kDataMark = "\"@GROVE_DATA@\"";

std::string_view page_template(PageKind kind) {
  switch (kind) {
    case PageKind::report:
      return embedded_report_page();
    case PageKind::structure:
      return embedded_structure_page();
  }
  return {};
}

/// Text as HTML shows it.
std::string escape_text(std::string_view text) {
  std::string result;
  for (const char c : text) result += c == '&' ? std::string("&amp;") : c == '<' ? std::string("&lt;") : std::string(1, c);
  return result;
}

/// JSON that cannot end the script element that it is in: only strings hold '<', and there it can be written as an escape.
std::string script_json(const nlohmann::ordered_json& data) {
  const std::string json = data.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::string result;
  result.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      result += "\\u003c";
    } else {
      result += c;
    }
  }
  return result;
}

}  // namespace

void check_page_available(PageKind kind) {
  if (page_template(kind).empty())
    throw UsageError(
        "this grove was built without the pages of its reports; install the packages nodejs (18 or later) and npm, and build it again");
}

std::string html_page(PageKind kind, const std::string& title, const nlohmann::ordered_json& data) {
  check_page_available(kind);
  const std::string_view page = page_template(kind);
  const std::size_t title_at = page.find(kTitleMark);
  const std::size_t data_at = page.find(kDataMark, title_at);
  GROVE_CHECK(title_at != std::string_view::npos && data_at != std::string_view::npos);
  const std::string json = script_json(data);
  std::string result;
  result.reserve(page.size() + json.size() + title.size());
  result += page.substr(0, title_at);
  result += escape_text(title);
  result += page.substr(title_at + kTitleMark.size(), data_at - title_at - kTitleMark.size());
  result += json;
  result += page.substr(data_at + kDataMark.size());
  return result;
}

}  // namespace grove
