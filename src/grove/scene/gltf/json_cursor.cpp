#include "grove/scene/gltf/json_cursor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "grove/base/error.h"

namespace grove {

JsonCursor::JsonCursor(const nlohmann::json& root, const std::string& file) : value_(&root), file_(&file) {}

JsonCursor JsonCursor::operator[](std::string_view key) const {
  std::string path = path_.empty() ? std::string(key) : path_ + "." + std::string(key);
  if (value_ == nullptr) return {nullptr, file_, std::move(path)};
  if (!value_->is_object()) fail("expected an object");
  const auto found = value_->find(key);
  return {found == value_->end() ? nullptr : &*found, file_, std::move(path)};
}

JsonCursor JsonCursor::element(std::size_t i) const {
  return {&(*value_)[i], file_, path_ + "[" + std::to_string(i) + "]"};
}

JsonCursor JsonCursor::extension(std::string_view name) const {
  return (*this)["extensions"][name];
}

std::size_t JsonCursor::size() const {
  if (value_ == nullptr) return 0;
  if (!value_->is_array()) fail("expected an array");
  return value_->size();
}

std::vector<std::string> JsonCursor::keys() const {
  std::vector<std::string> names;
  if (value_ == nullptr) return names;
  if (!value_->is_object()) fail("expected an object");
  for (const auto& item : value_->items()) names.push_back(item.key());
  return names;
}

double JsonCursor::number(double fallback) const {
  if (value_ == nullptr) return fallback;
  if (!value_->is_number()) fail("expected a number");
  return value_->get<double>();
}

float JsonCursor::real(float fallback) const {
  return to_float(number(fallback));
}

bool JsonCursor::boolean(bool fallback) const {
  if (value_ == nullptr) return fallback;
  if (!value_->is_boolean()) fail("expected true or false");
  return value_->get<bool>();
}

std::string JsonCursor::text(std::string_view fallback) const {
  if (value_ == nullptr) return std::string(fallback);
  if (!value_->is_string()) fail("expected a string");
  return value_->get<std::string>();
}

std::uint64_t JsonCursor::whole(std::uint64_t fallback) const {
  return value_ == nullptr ? fallback : whole();
}

std::uint64_t JsonCursor::whole() const {
  // Some writers put 3.0 where 3 is meant, so the number is judged by its value. Above 2^53 doubles are no longer exact.
  const double value = number(-1.0);
  if (!(value >= 0.0 && value < 0x1p53 && value == std::floor(value))) fail("expected a whole number of 0 or more");
  return static_cast<std::uint64_t>(value);
}

std::optional<std::uint32_t> JsonCursor::index(std::size_t count, std::string_view what) const {
  if (value_ == nullptr) return std::nullopt;
  return required_index(count, what);
}

std::uint32_t JsonCursor::required_index(std::size_t count, std::string_view what) const {
  const std::uint64_t value = whole();
  if (value >= count || value > std::numeric_limits<std::uint32_t>::max()) {
    fail("names number " + std::to_string(value) + " of " + std::to_string(count) + " " + std::string(what));
  }
  return static_cast<std::uint32_t>(value);
}

std::vector<double> JsonCursor::numbers(std::size_t count) const {
  std::vector<double> values;
  if (value_ == nullptr) return values;
  if (size() != count) fail("expected " + std::to_string(count) + " numbers");
  for (std::size_t i = 0; i < count; ++i) values.push_back(element(i).number(0.0));
  return values;
}

Vec2 JsonCursor::vec2(const Vec2& fallback) const {
  const std::vector<double> v = numbers(2);
  return v.empty() ? fallback : Vec2(to_float(v[0]), to_float(v[1]));
}

Vec3 JsonCursor::vec3(const Vec3& fallback) const {
  const std::vector<double> v = numbers(3);
  return v.empty() ? fallback : Vec3(to_float(v[0]), to_float(v[1]), to_float(v[2]));
}

Vec4 JsonCursor::vec4(const Vec4& fallback) const {
  const std::vector<double> v = numbers(4);
  return v.empty() ? fallback : Vec4(to_float(v[0]), to_float(v[1]), to_float(v[2]), to_float(v[3]));
}

void JsonCursor::fail(std::string_view problem) const {
  // Names out of the file may hold line breaks, and messages are one line.
  std::string line(problem);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
  throw InputError(*file_, path_, line);
}

}  // namespace grove
