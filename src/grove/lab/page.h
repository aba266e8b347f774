#pragma once

// Results as a page to look at: one file of HTML that needs no network.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace grove {

/// A page is a folder of web/.
enum class PageKind : std::uint8_t { report, structure };

/// Throws UsageError, which names the packages that are missing, where Grove was built without its pages. For before the work starts.
void check_page_available(PageKind kind);

/// The page with `title` and `data` in it, which must be of a format that the page knows; docs/reports.md has them. Text that is not UTF-8 is
/// shown with replacement characters. Throws as `check_page_available` does. Any number of threads may call it.
[[nodiscard]] std::string html_page(PageKind kind, const std::string& title, const nlohmann::ordered_json& data);

}  // namespace grove
