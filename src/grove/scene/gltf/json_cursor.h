#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "grove/math/to_float.h"
#include "grove/math/vector.h"

namespace grove {

/// A place in a JSON document that may hold a value or nothing, and knows its path for messages ("nodes[3].translation").
/// Reading a value of another type than asked for throws InputError naming file and path; reading nothing gives the fallback.
/// Refers to the document and the file name: both must outlive it. Cheap to copy but for the path.
class JsonCursor {
 public:
  JsonCursor(const nlohmann::json& root, const std::string& file);

  [[nodiscard]] bool exists() const { return value_ != nullptr; }
  [[nodiscard]] const std::string& path() const { return path_; }

  /// The member of that name; nothing when it or this is absent. This must be an object or absent.
  [[nodiscard]] JsonCursor operator[](std::string_view key) const;
  /// Element `i` < size() of an array.
  [[nodiscard]] JsonCursor element(std::size_t i) const;
  /// `extensions` and then `name`.
  [[nodiscard]] JsonCursor extension(std::string_view name) const;

  /// Elements of an array; 0 when absent.
  [[nodiscard]] std::size_t size() const;
  /// The names of an object's members; none when absent.
  [[nodiscard]] std::vector<std::string> keys() const;

  [[nodiscard]] double number(double fallback) const;
  /// `number`, as a float; beyond its range an infinity.
  [[nodiscard]] float real(float fallback) const;
  [[nodiscard]] bool boolean(bool fallback) const;
  [[nodiscard]] std::string text(std::string_view fallback = {}) const;
  /// A whole number of 0 or more, below 2^53.
  [[nodiscard]] std::uint64_t whole(std::uint64_t fallback) const;
  /// The same, which must be there.
  [[nodiscard]] std::uint64_t whole() const;
  /// An index below `count`, when there is one. `what` is what it counts, for the message.
  [[nodiscard]] std::optional<std::uint32_t> index(std::size_t count, std::string_view what) const;
  /// The same, which must be there.
  [[nodiscard]] std::uint32_t required_index(std::size_t count, std::string_view what) const;
  /// Exactly `count` numbers; empty when absent.
  [[nodiscard]] std::vector<double> numbers(std::size_t count) const;
  [[nodiscard]] Vec2 vec2(const Vec2& fallback) const;
  [[nodiscard]] Vec3 vec3(const Vec3& fallback) const;
  [[nodiscard]] Vec4 vec4(const Vec4& fallback) const;

  /// Throws InputError with this place.
  [[noreturn]] void fail(std::string_view problem) const;

 private:
  JsonCursor(const nlohmann::json* value, const std::string* file, std::string path) : value_(value), file_(file), path_(std::move(path)) {}

  const nlohmann::json* value_;
  const std::string* file_;
  std::string path_;
};

}  // namespace grove
