#include "grove/scene/builtin/options.h"

#include <algorithm>
#include <charconv>
#include <cstdio>

#include "grove/base/error.h"
#include "grove/scene/formats/text.h"

namespace grove {
namespace {

std::string listed(std::initializer_list<std::string_view> words) {
  std::string text;
  for (const std::string_view word : words) text += std::string(text.empty() ? "" : ", ") + std::string(word);
  return text;
}

}  // namespace

BuiltinOptions::BuiltinOptions(std::string_view request) {
  const std::size_t question = std::min(request.find('?'), request.size());
  name_ = request.substr(0, question);
  std::string_view rest = request.substr(std::min(question + 1, request.size()));
  while (!rest.empty()) {
    const std::string_view pair = rest.substr(0, rest.find('&'));
    rest.remove_prefix(std::min(pair.size() + 1, rest.size()));
    const std::size_t equals = pair.find('=');
    if (equals == std::string_view::npos || equals == 0) fail("expected key=value, found " + quote(pair));
    entries_.push_back({std::string(pair.substr(0, equals)), std::string(pair.substr(equals + 1))});
  }
}

void BuiltinOptions::allow_only(std::initializer_list<std::string_view> keys) const {
  for (const Entry& entry : entries_) {
    if (std::find(keys.begin(), keys.end(), entry.key) == keys.end()) {
      fail("unknown key " + quote(entry.key) + "; allowed are " + listed(keys));
    }
    if (find(entry.key) != &entry.value) fail("key " + quote(entry.key) + " is given twice");
  }
}

std::uint64_t BuiltinOptions::integer(std::string_view key, std::uint64_t fallback, std::uint64_t least, std::uint64_t most) const {
  const std::string* const text = find(key);
  if (text == nullptr) return fallback;
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), value);
  if (error != std::errc() || end != text->data() + text->size() || value < least || value > most) {
    fail("value " + quote(*text) + " of " + std::string(key) + "; allowed are integers from " + std::to_string(least) + " to " +
         std::to_string(most));
  }
  return value;
}

double BuiltinOptions::number(std::string_view key, double fallback, double least, double most) const {
  const std::string* const text = find(key);
  if (text == nullptr) return fallback;
  double value = 0.0;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), value);
  if (error != std::errc() || end != text->data() + text->size() || !(value >= least && value <= most)) {
    char range[64];
    std::snprintf(range, sizeof range, "%g to %g", least, most);
    fail("value " + quote(*text) + " of " + std::string(key) + "; allowed are numbers from " + range);
  }
  return value;
}

std::string_view BuiltinOptions::choice(std::string_view key, std::initializer_list<std::string_view> allowed) const {
  const std::string* const text = find(key);
  if (text == nullptr) return *allowed.begin();
  const auto found = std::find(allowed.begin(), allowed.end(), *text);
  if (found == allowed.end()) fail("value " + quote(*text) + " of " + std::string(key) + "; allowed are " + listed(allowed));
  return *found;
}

bool BuiltinOptions::boolean(std::string_view key, std::string_view fallback) const {
  if (!has(key)) return fallback == "true";
  return choice(key, {"true", "false"}) == "true";
}

std::uint64_t BuiltinOptions::seed() const {
  return integer("seed", 1, 0, 0xffffffffffffffffULL);
}

std::uint64_t BuiltinOptions::target() const {
  if (int{has("size")} + int{has("triangles")} + int{has("primitives")} > 1) {
    fail("size, triangles and primitives each set the size; give one of them");
  }
  return integer(has("triangles") ? "triangles" : "primitives", 0, 1, kMaxBuiltinPrimitives);
}

void BuiltinOptions::fail(std::string_view problem) const {
  throw UsageError("builtin:" + name_ + ": " + std::string(problem));
}

const std::string* BuiltinOptions::find(std::string_view key) const {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.key == key; });
  return found == entries_.end() ? nullptr : &found->value;
}

}  // namespace grove
