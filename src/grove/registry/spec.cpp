#include "grove/registry/spec.h"

#include <algorithm>
#include <charconv>

#include "grove/base/error.h"

namespace grove {
namespace {

std::string join(const std::vector<std::string_view>& words) {
  std::string line;
  for (const std::string_view word : words) line += (line.empty() ? "" : ", ") + std::string(word);
  return line;
}

// A family, and the key that its short name sets, if it was called by one.
struct NamedFamily {
  const StructureFamily* family;
  const ShortSpec* short_for = nullptr;
};

NamedFamily find_family(std::string_view name) {
  std::vector<std::string_view> known;
  for (const StructureFamily& family : structure_families()) {
    if (family.name == name) return {&family};
    known.push_back(family.name);
    for (const ShortSpec& short_for : family.shorts) {
      if (short_for.name == name) return {&family, &short_for};
      known.push_back(short_for.name);
    }
  }
  throw UsageError("unknown structure '" + std::string(name) + "'; there are: " + join(known));
}

const SpecKey& find_key(const StructureFamily& family, std::string_view name) {
  std::vector<std::string_view> known;
  for (const SpecKey& key : family.keys) {
    if (key.name == name) return key;
    known.push_back(key.name);
  }
  throw UsageError("structure '" + std::string(family.name) + "' has no key '" + std::string(name) + "'; " +
                   (known.empty() ? "it has none" : "its keys are: " + join(known)));
}

void check_value(const StructureFamily& family, const SpecKey& key, std::string_view value) {
  const std::string subject = "structure '" + std::string(family.name) + "': " + std::string(key.name) + "=" + std::string(value);
  if (!key.is_number()) {
    if (std::find(key.values.begin(), key.values.end(), value) == key.values.end())
      throw UsageError(subject + " is not allowed; use one of: " + join(key.values));
    return;
  }
  int number = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  if (error != std::errc() || end != value.data() + value.size() || number < key.minimum || number > key.maximum)
    throw UsageError(subject + " is not allowed; use a whole number from " + std::to_string(key.minimum) + " to " +
                     std::to_string(key.maximum));
}

}  // namespace

Spec Spec::parse(std::string_view text) {
  const std::size_t colon = text.find(':');
  Spec spec;
  const auto [family, short_for] = find_family(text.substr(0, colon));
  spec.family_ = family;
  for (const SpecKey& key : spec.family_->keys) spec.values_.emplace(key.name, key.default_value());
  std::vector<std::string_view> seen;
  if (short_for != nullptr) {
    spec.values_.find(short_for->key)->second = short_for->value;
    seen.push_back(short_for->key);
  }
  if (colon == std::string_view::npos) return spec;

  std::string_view rest = text.substr(colon + 1);
  for (bool more = true; more;) {
    const std::size_t comma = rest.find(',');
    const std::string_view pair = rest.substr(0, comma);
    more = comma != std::string_view::npos;
    if (more) rest.remove_prefix(comma + 1);
    const std::size_t equals = pair.find('=');
    if (equals == std::string_view::npos)
      throw UsageError("structure '" + std::string(text) + "': expected key=value, found '" + std::string(pair) + "'");
    const SpecKey& key = find_key(*spec.family_, pair.substr(0, equals));
    const std::string_view value = pair.substr(equals + 1);
    check_value(*spec.family_, key, value);
    if (std::find(seen.begin(), seen.end(), key.name) != seen.end())
      throw UsageError("structure '" + std::string(text) + "': key '" + std::string(key.name) + "' is given twice");
    seen.push_back(key.name);
    // Numbers lose leading zeros, so that equal specs have one canonical form.
    spec.values_.find(key.name)->second = key.is_number() ? std::to_string(std::stoi(std::string(value))) : std::string(value);
  }
  return spec;
}

const std::string& Spec::value(std::string_view key) const {
  return values_.find(key)->second;
}

int Spec::number(std::string_view key) const {
  return std::stoi(value(key));
}

std::string Spec::canonical() const {
  std::string text(family_->name);
  char separator = ':';
  for (const SpecKey& key : family_->keys) {
    if (value(key.name) == key.default_value()) continue;
    text += separator + std::string(key.name) + "=" + value(key.name);
    separator = ',';
  }
  return text;
}

}  // namespace grove
