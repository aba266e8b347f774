#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "grove/math/vector.h"
#include "grove/scene/pbrt/place.h"
#include "grove/scene/pbrt/tokenizer.h"

namespace grove::pbrt {

enum class ParameterType : std::uint8_t {
  boolean,
  integer,
  real,
  point2,
  point3,
  vector2,
  vector3,
  normal,
  rgb,
  spectrum,
  blackbody,
  string,
  texture
};

/// The colour space that rgb values are in (the ColorSpace directive).
enum class ColourSpace : std::uint8_t { srgb, dci_p3, rec2020, aces2065_1 };

/// One `"type name" value` of a directive. Which of the vectors is filled follows from the type.
struct Parameter {
  ParameterType type = ParameterType::real;
  std::string name;
  Place place;
  std::vector<float> numbers;          ///< all types but the following
  std::vector<std::int32_t> integers;  ///< integer
  std::vector<bool> flags;             ///< boolean
  std::vector<std::string> strings;    ///< string, texture, and a spectrum by name
  mutable bool used = false;           ///< looked up by the one thread that builds from it
};

/// The parameters of one directive, behind which stand those that an Attribute directive gave for its kind.
/// The lookups take the first parameter with the name whose type fits; a value of the wrong size throws InputError at its place.
class ParameterList {
 public:
  ParameterList() = default;
  explicit ParameterList(Place place) : place_(std::move(place)) {}

  void add(Parameter parameter) { own_.push_back(std::move(parameter)); }
  void set_defaults(std::shared_ptr<const std::vector<Parameter>> defaults) { defaults_ = std::move(defaults); }
  void set_colour_space(ColourSpace space) { colour_space_ = space; }

  /// Null where there is no such parameter. Marks it as used.
  [[nodiscard]] const Parameter* find(std::string_view name) const;
  /// The same, for one type only.
  [[nodiscard]] const Parameter* find(std::string_view name, ParameterType type) const;

  /// Marks a parameter as known that has no effect here.
  void ignore(std::string_view name) const { static_cast<void>(find(name)); }

  /// One finite number (real or integer).
  [[nodiscard]] std::optional<float> number(std::string_view name) const;
  [[nodiscard]] float number(std::string_view name, float otherwise) const { return number(name).value_or(otherwise); }
  [[nodiscard]] std::optional<std::int32_t> integer(std::string_view name) const;
  [[nodiscard]] std::int32_t integer(std::string_view name, std::int32_t otherwise) const { return integer(name).value_or(otherwise); }
  [[nodiscard]] bool flag(std::string_view name, bool otherwise) const;
  [[nodiscard]] std::string text(std::string_view name, std::string_view otherwise) const;
  /// The name of the texture, or nothing.
  [[nodiscard]] std::optional<std::string> texture(std::string_view name) const;
  /// One finite point3 or vector3.
  [[nodiscard]] Vec3 point(std::string_view name, const Vec3& otherwise) const;

  /// Arrays; empty where there is no such parameter. Numbers may be NaN or infinite.
  [[nodiscard]] std::vector<Vec3> vectors3(std::string_view name) const;
  [[nodiscard]] std::vector<Vec2> vectors2(std::string_view name) const;
  [[nodiscard]] std::span<const std::int32_t> integers(std::string_view name) const;

  [[nodiscard]] const Place& place() const { return place_; }
  [[nodiscard]] ColourSpace colour_space() const { return colour_space_; }
  [[nodiscard]] const std::vector<Parameter>& own() const { return own_; }
  /// The names of all textures that are referred to, in its own parameters and in those behind them.
  [[nodiscard]] std::vector<std::string_view> texture_names() const;

 private:
  std::vector<Parameter> own_;
  std::shared_ptr<const std::vector<Parameter>> defaults_;
  Place place_;
  ColourSpace colour_space_ = ColourSpace::srgb;
};

/// Reads parameters up to the first token that does not start one. Values stand in brackets or, when there is but one, without.
/// Throws InputError for an unknown type, a value of the wrong kind, a missing bracket, or a number of values that does not fit the type.
[[nodiscard]] ParameterList parse_parameters(Tokenizer& tokens, const Place& directive);

}  // namespace grove::pbrt
