#include "grove/scene/pbrt/parameters.h"

#include <cmath>

namespace grove::pbrt {
namespace {

bool holds_triples(ParameterType type) {
  return type == ParameterType::point3 || type == ParameterType::vector3 || type == ParameterType::normal || type == ParameterType::rgb;
}

}  // namespace

const Parameter* ParameterList::find(std::string_view name) const {
  for (const Parameter& parameter : own_) {
    if (parameter.name != name) continue;
    parameter.used = true;
    return &parameter;
  }
  // Defaults are shared between threads, so they are not marked: they need not fit every directive.
  if (defaults_ != nullptr) {
    for (const Parameter& parameter : *defaults_) {
      if (parameter.name == name) return &parameter;
    }
  }
  return nullptr;
}

const Parameter* ParameterList::find(std::string_view name, ParameterType type) const {
  for (const Parameter& parameter : own_) {
    if (parameter.name != name || parameter.type != type) continue;
    parameter.used = true;
    return &parameter;
  }
  if (defaults_ != nullptr) {
    for (const Parameter& parameter : *defaults_) {
      if (parameter.name == name && parameter.type == type) return &parameter;
    }
  }
  return nullptr;
}

std::optional<float> ParameterList::number(std::string_view name) const {
  if (const Parameter* p = find(name, ParameterType::real)) {
    if (p->numbers.size() != 1) p->place.fail("\"" + p->name + "\" takes one number");
    if (!std::isfinite(p->numbers[0])) p->place.fail("\"" + p->name + "\" must be a finite number");
    return p->numbers[0];
  }
  const std::optional<std::int32_t> whole = integer(name);
  return whole ? std::optional<float>(static_cast<float>(*whole)) : std::nullopt;
}

std::optional<std::int32_t> ParameterList::integer(std::string_view name) const {
  const Parameter* p = find(name, ParameterType::integer);
  if (p == nullptr) return std::nullopt;
  if (p->integers.size() != 1) p->place.fail("\"" + p->name + "\" takes one integer");
  return p->integers[0];
}

bool ParameterList::flag(std::string_view name, bool otherwise) const {
  const Parameter* p = find(name, ParameterType::boolean);
  if (p == nullptr) return otherwise;
  if (p->flags.size() != 1) p->place.fail("\"" + p->name + "\" takes one of true and false");
  return p->flags[0];
}

std::string ParameterList::text(std::string_view name, std::string_view otherwise) const {
  const Parameter* p = find(name, ParameterType::string);
  if (p == nullptr) return std::string(otherwise);
  if (p->strings.size() != 1) p->place.fail("\"" + p->name + "\" takes one string");
  return p->strings[0];
}

std::optional<std::string> ParameterList::texture(std::string_view name) const {
  const Parameter* p = find(name, ParameterType::texture);
  if (p == nullptr) return std::nullopt;
  if (p->strings.size() != 1) p->place.fail("\"" + p->name + "\" takes the name of one texture");
  return p->strings[0];
}

Vec3 ParameterList::point(std::string_view name, const Vec3& otherwise) const {
  const Parameter* p = find(name);
  if (p == nullptr || !holds_triples(p->type)) return otherwise;
  if (p->numbers.size() != 3) p->place.fail("\"" + p->name + "\" takes three numbers");
  for (const float x : p->numbers) {
    if (!std::isfinite(x)) p->place.fail("\"" + p->name + "\" must have finite numbers");
  }
  return {p->numbers[0], p->numbers[1], p->numbers[2]};
}

std::vector<Vec3> ParameterList::vectors3(std::string_view name) const {
  std::vector<Vec3> result;
  const Parameter* p = find(name);
  if (p == nullptr || !holds_triples(p->type)) return result;
  result.reserve(p->numbers.size() / 3);
  for (std::size_t i = 0; i + 2 < p->numbers.size(); i += 3) {
    result.emplace_back(p->numbers[i], p->numbers[i + 1], p->numbers[i + 2]);
  }
  return result;
}

std::vector<Vec2> ParameterList::vectors2(std::string_view name) const {
  std::vector<Vec2> result;
  const Parameter* p = find(name);
  // Version 3 of the format wrote texture coordinates as plain floats.
  if (p == nullptr || (p->type != ParameterType::point2 && p->type != ParameterType::vector2 && p->type != ParameterType::real)) {
    return result;
  }
  if (p->numbers.size() % 2 != 0) p->place.fail("\"" + p->name + "\" takes an even number of values");
  result.reserve(p->numbers.size() / 2);
  for (std::size_t i = 0; i + 1 < p->numbers.size(); i += 2) result.emplace_back(p->numbers[i], p->numbers[i + 1]);
  return result;
}

std::vector<std::string_view> ParameterList::texture_names() const {
  std::vector<std::string_view> names;
  const auto collect = [&names](const std::vector<Parameter>& parameters) {
    for (const Parameter& p : parameters) {
      if (p.type == ParameterType::texture && !p.strings.empty()) names.push_back(p.strings[0]);
    }
  };
  collect(own_);
  if (defaults_ != nullptr) collect(*defaults_);
  return names;
}

std::span<const std::int32_t> ParameterList::integers(std::string_view name) const {
  const Parameter* p = find(name, ParameterType::integer);
  return p == nullptr ? std::span<const std::int32_t>() : std::span<const std::int32_t>(p->integers);
}

}  // namespace grove::pbrt
