#include "html_file.h"

#include "grove/base/error.h"
#include "grove/base/output_file.h"

namespace grove::app {

void add_html(CLI::App& verb, CommonOptions& options, const std::string& what) {
  verb.add_option("--html", options.html, "Write " + what + " to this file as a page to look at in a browser, with charts")
      ->type_name("FILE");
}

void check_html(const CommonOptions& options, PageKind kind) {
  if (options.html.empty()) return;
  try {
    check_page_available(kind);
  } catch (const UsageError& error) {
    throw UsageError(std::string("--html: ") + error.what());
  }
  check_writable(options.html);
}

void write_html(const CommonOptions& options, PageKind kind, const std::string& title, const nlohmann::ordered_json& data) {
  if (!options.html.empty()) write_text_file(options.html, html_page(kind, title, data));
}

}  // namespace grove::app
