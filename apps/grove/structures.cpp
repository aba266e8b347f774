#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "grove/lab/text_table.h"
#include "grove/registry/registry.h"
#include "verbs.h"

namespace grove::app {
namespace {

std::string allowed_values(const SpecKey& key) {
  if (key.is_number()) return fmt::format("{}..{}", key.minimum, key.maximum);
  std::string text;
  for (const std::string_view value : key.values) text += (text.empty() ? "" : "|") + std::string(value);
  return text;
}

std::string as_text() {
  std::string text;
  for (const StructureFamily& family : structure_families()) {
    text += fmt::format("{}\n  {}\n", family.name, family.summary);
    if (!family.keys.empty()) {
      TextTable table({{"  key"}, {"values"}, {"default"}, {"what it does"}});
      for (const SpecKey& key : family.keys) {
        table.add_row({"  " + std::string(key.name), allowed_values(key), key.default_value(), std::string(key.summary)});
      }
      text += '\n' + table.text();
    }
    for (const ShortSpec& short_for : family.shorts)
      text += fmt::format("\n  {} is short for {}:{}={}\n", short_for.name, family.name, short_for.key, short_for.value);
    text += '\n';
  }
  return text + fmt::format("A structure is named family or family:key=value,key=value; the default is {}.\n", kDefaultSpec);
}

std::string as_json() {
  nlohmann::ordered_json families = nlohmann::ordered_json::array();
  for (const StructureFamily& family : structure_families()) {
    nlohmann::ordered_json keys = nlohmann::ordered_json::array();
    for (const SpecKey& key : family.keys) {
      nlohmann::ordered_json entry{{"name", key.name}, {"summary", key.summary}};
      if (key.is_number()) {
        entry["minimum"] = key.minimum;
        entry["maximum"] = key.maximum;
        entry["default"] = key.default_number;
      } else {
        entry["values"] = key.values;
        entry["default"] = key.values.front();
      }
      keys.push_back(std::move(entry));
    }
    nlohmann::ordered_json shorts = nlohmann::ordered_json::array();
    for (const ShortSpec& short_for : family.shorts)
      shorts.push_back({{"name", short_for.name}, {"key", short_for.key}, {"value", short_for.value}});
    families.push_back({{"name", family.name}, {"summary", family.summary}, {"keys", std::move(keys)}, {"shorts", std::move(shorts)}});
  }
  const nlohmann::ordered_json json{
      {"default", kDefaultSpec}, {"families", std::move(families)}, {"representative_specs", representative_specs()}};
  return json.dump(2) + "\n";
}

}  // namespace

Verb add_structures(CLI::App& program) {
  const auto json = std::make_shared<bool>(false);
  CLI::App& verb = *program.add_subcommand("structures", "List the acceleration structures, their keys and defaults");
  verb.add_flag("--json", *json, "Print them as JSON");
  verb.footer("Examples:\n  grove structures\n  grove structures --json");
  return {&verb, [json](Interrupts& /*interrupts*/) {
            fmt::print("{}", *json ? as_json() : as_text());
            return 0;
          }};
}

}  // namespace grove::app
