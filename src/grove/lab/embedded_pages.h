#pragma once

#include <string_view>

namespace grove {

/// The page of web/report as it was built, with marks where title and data go; empty when Grove was built without it.
[[nodiscard]] std::string_view embedded_report_page();
/// The same for web/structure.
[[nodiscard]] std::string_view embedded_structure_page();

}  // namespace grove
