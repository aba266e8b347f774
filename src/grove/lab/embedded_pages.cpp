#include "grove/lab/embedded_pages.h"

// The assembler takes a file in as it is, at once; as a string literal a page of a megabyte would take the compiler seconds.
// GROVE_PAGES_DIRECTORY is where the pages are.

// clang-format off
#define GROVE_LABEL(NAME) ".global " NAME "\n" NAME ":\n"
#define GROVE_EMBED_PAGE(SYMBOL, FILE)                  \
  asm(".pushsection .rodata\n"                          \
      GROVE_LABEL(SYMBOL "_begin")                      \
      ".incbin \"" GROVE_PAGES_DIRECTORY "/" FILE "\"\n" \
      GROVE_LABEL(SYMBOL "_end")                        \
      ".byte 0\n"                                       \
      ".popsection\n")
// clang-format on

GROVE_EMBED_PAGE("grove_report_page", "report.html");
GROVE_EMBED_PAGE("grove_structure_page", "structure.html");

extern "C" const char kReportPageBegin[] asm("grove_report_page_begin");
extern "C" const char kReportPageEnd[] asm("grove_report_page_end");
extern "C" const char kStructurePageBegin[] asm("grove_structure_page_begin");
extern "C" const char kStructurePageEnd[] asm("grove_structure_page_end");

namespace grove {

std::string_view embedded_report_page() {
  return {kReportPageBegin, static_cast<std::size_t>(kReportPageEnd - kReportPageBegin)};
}

std::string_view embedded_structure_page() {
  return {kStructurePageBegin, static_cast<std::size_t>(kStructurePageEnd - kStructurePageBegin)};
}

}  // namespace grove
