#include "options.h"

#include <fmt/format.h>

#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <charconv>
#include <cmath>

#include "grove/base/error.h"
#include "grove/registry/registry.h"

namespace grove::app {
namespace {

/// More threads than any machine has, few enough to start.
constexpr std::uint64_t kMostThreads = 1024;

/// The whole of `text` as a number, or nothing.
template <typename Number>
std::optional<Number> parse_number(const std::string& text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end) return std::nullopt;
  return number;
}

}  // namespace

void add_scene(CLI::App& verb, CommonOptions& options) {
  verb.add_option("SCENE", options.scene, "A file (.gltf .glb .pbrt .obj .ply .ply.gz .stl) or builtin:NAME?key=value&key=value")
      ->required()
      ->type_name("");
}

void add_structure(CLI::App& verb, CommonOptions& options) {
  options.structure = kDefaultSpec;
  verb.add_option("--structure", options.structure, "Acceleration structure, family or family:key=value,...; see 'grove structures'")
      ->type_name("SPEC")
      ->capture_default_str();
}

void add_threads(CLI::App& verb, CommonOptions& options) {
  in_range(verb.add_option("--threads", options.threads, "Threads to use (default: all that the machine has)")->type_name("T"),
           std::uint64_t{1}, kMostThreads);
}

void add_json(CLI::App& verb, CommonOptions& options, const std::string& what) {
  verb.add_option("--json", options.json, "Write " + what + " to this file as JSON")->type_name("FILE");
}

void add_quiet(CLI::App& verb, CommonOptions& options) {
  verb.add_flag("--quiet", options.quiet, "No progress, remarks or warnings; errors only");
}

CLI::Option* in_range(CLI::Option* option, std::uint64_t minimum, std::uint64_t maximum) {
  return option->check(CLI::Validator(
      [=](const std::string& text) {
        const auto number = parse_number<std::uint64_t>(text);
        if (number && *number >= minimum && *number <= maximum) return std::string();
        return fmt::format("'{}' is not a whole number from {} to {}", text, minimum, maximum);
      },
      ""));
}

CLI::Option* in_range(CLI::Option* option, double minimum, double maximum) {
  return option->check(CLI::Validator(
      [=](const std::string& text) {
        const auto number = parse_number<double>(text);
        if (number && *number >= minimum && *number <= maximum) return std::string();
        return fmt::format("'{}' is not a number from {} to {}", text, minimum, maximum);
      },
      ""));
}

std::uint64_t parse_size(const std::string& option, const std::string& text) {
  const std::size_t digits = std::min(text.find_first_not_of("0123456789."), text.size());
  const auto number = parse_number<double>(text.substr(0, digits));
  const std::string unit = text.substr(digits);
  constexpr std::string_view kPrefixes = "KMGT";
  double factor = 0.0;
  if (unit.empty() || unit == "B") {
    factor = 1.0;
  } else if (const std::size_t power = kPrefixes.find(unit.front()); power != std::string_view::npos) {
    const std::string rest = unit.substr(1);
    const auto exponent = static_cast<double>(power + 1);
    if (rest.empty() || rest == "iB") factor = std::pow(1024.0, exponent);
    if (rest == "B") factor = std::pow(1000.0, exponent);
  }
  const double bytes = number.value_or(0.0) * factor;
  if (!(bytes >= 1.0) || bytes >= 0x1p63)
    throw UsageError(fmt::format("{}: '{}' is not a size; write bytes, or a number with K, M or G, as in 500M or 2GiB", option, text));
  return static_cast<std::uint64_t>(bytes);
}

Vec3 parse_vector(const char* option, const std::string& text, const char* form) {
  Vec3 vector(0.0F);
  const char* const end = text.data() + text.size();
  const char* place = text.data();
  for (int axis = 0; axis < 3; ++axis) {
    const auto [stop, error] = std::from_chars(place, end, vector[axis]);
    const bool is_last = axis == 2;
    const bool is_right = error == std::errc() && std::isfinite(vector[axis]) && (is_last ? stop == end : stop != end && *stop == ',');
    if (!is_right) throw UsageError(fmt::format("{}: '{}' is not three numbers {}", option, text, form));
    place = stop + 1;
  }
  return vector;
}

std::vector<std::string> split_list(const std::string& option, const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t first = 0;
  while (first <= text.size()) {
    const std::size_t end = std::min(text.find(separator, first), text.size());
    std::string part = text.substr(first, end - first);
    part.erase(0, std::min(part.find_first_not_of(' '), part.size()));
    part.erase(part.find_last_not_of(' ') + 1);
    if (part.empty()) throw UsageError(fmt::format("{}: '{}' has an empty entry", option, text));
    parts.push_back(std::move(part));
    first = end + 1;
  }
  return parts;
}

}  // namespace grove::app
