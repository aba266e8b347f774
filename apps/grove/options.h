#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "grove/math/vector.h"

namespace grove::app {

/// What most verbs ask for.
struct CommonOptions {
  std::string scene;
  std::string structure;
  /// Nothing: as many as the machine has.
  std::optional<unsigned> threads;
  std::filesystem::path json;
  std::filesystem::path html;
  bool quiet = false;
};

void add_scene(CLI::App& verb, CommonOptions& options);
void add_structure(CLI::App& verb, CommonOptions& options);
void add_threads(CLI::App& verb, CommonOptions& options);
void add_json(CLI::App& verb, CommonOptions& options, const std::string& what);
void add_quiet(CLI::App& verb, CommonOptions& options);

/// Lets an option take whole numbers from `minimum` to `maximum` only, with an error that says so.
CLI::Option* in_range(CLI::Option* option, std::uint64_t minimum, std::uint64_t maximum);
/// The same for numbers with a fraction.
CLI::Option* in_range(CLI::Option* option, double minimum, double maximum);

/// Bytes: a number with B, K, M, G or T, with KB and so on for powers of 1000 and KiB and so on for powers of 1024, which K alone means too.
/// Throws UsageError for anything else, 0 and less, and 2^63 and more.
std::uint64_t parse_size(const std::string& option, const std::string& text);

/// Three finite numbers with commas between them. Throws UsageError for anything else; `form` is what it should look like, such as "x,y,z".
Vec3 parse_vector(const char* option, const std::string& text, const char* form);

/// The parts of a list, without the spaces around them. Throws UsageError when one is empty.
std::vector<std::string> split_list(const std::string& option, const std::string& text, char separator);

}  // namespace grove::app
