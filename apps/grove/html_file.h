#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "grove/lab/page.h"
#include "options.h"

namespace grove::app {

/// --html FILE, into options.html.
void add_html(CLI::App& verb, CommonOptions& options, const std::string& what);

/// Before the work starts: throws UsageError where Grove was built without the page, OutputError where the file cannot be written. Nothing is
/// checked where no file was asked for.
void check_html(const CommonOptions& options, PageKind kind);

/// Writes the page with `data` in it, where a file was asked for.
void write_html(const CommonOptions& options, PageKind kind, const std::string& title, const nlohmann::ordered_json& data);

}  // namespace grove::app
