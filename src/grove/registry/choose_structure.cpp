#include "grove/registry/choose_structure.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <utility>

#include "grove/registry/spec.h"

namespace grove {
namespace {

/// What a structure takes, relative to `fast`: medians over the scenes of docs/bvh-scenes.md and docs/fast.md.
struct Price {
  std::string_view structure;
  double build;    ///< or following the geometry, in units of kBuild
  double trace;    ///< in units of the time of a ray
  double overlap;  ///< the same where boxes fit badly
};

/// Seconds that `fast` takes to build, for each primitive, on one thread of a processor of 2023. What matters is how it compares with kRay.
constexpr double kBuild = 5e-7;
/// Seconds that a ray takes through `fast` on the same thread, for each doubling of the number of primitives.
constexpr double kRay = 1e-8;
/// From here on boxes fit badly: long thin triangles across the axes have hundreds, a tessellated surface two to six, spheres two.
constexpr double kBadFit = 25.0;

constexpr std::array kStill{Price{"fast:quality=low", 0.55, 1.12, 1.1}, Price{"fast", 1.0, 1.0, 1.0},
                            Price{"fast:quality=high", 13.0, 0.94, 0.65}};
// `fast` has no refit and is built anew.
constexpr std::array kMoving{Price{"fast:quality=low", 0.55, 1.12, 1.1}, Price{"bvh:arity=8", 0.06, 2.2, 2.8}};
// Spheres, instances and others are tested one at a time by the same walk, whatever the family.
constexpr std::array kStillOthers{Price{"bvh:split=lbvh,arity=8", 0.55, 1.15, 1.15}, Price{"bvh:arity=8", 1.0, 1.0, 1.0},
                                  Price{"bvh:arity=8,optimize=reinsertion", 9.0, 0.93, 0.85}};
constexpr std::array kMovingOthers{Price{"bvh:arity=8", 0.06, 1.0, 1.0}};

std::string short_count(double count) {
  const std::array<std::pair<double, const char*>, 3> units{{{1e9, " G"}, {1e6, " M"}, {1e3, " k"}}};
  for (const auto& [unit, name] : units)
    if (count >= unit) return std::to_string(static_cast<long long>(std::llround(count / unit))) + name;
  return std::to_string(static_cast<long long>(std::llround(count)));
}

std::string one_decimal(double figure) {
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), figure, std::chars_format::fixed, 1);
  return {text.data(), end};
}

std::string_view name_of(GeometryKind kind) {
  constexpr std::array<std::string_view, 4> kNames{"triangles", "spheres", "instances", "primitives of your own"};
  return kNames.at(static_cast<std::size_t>(kind));
}

std::string percent(double part) {
  return std::to_string(static_cast<int>(std::lround(100.0 * part))) + " %";
}

/// The price list with the least time for building and tracing all rays, and why.
StructureChoice cheapest(std::span<const Price> prices, const GeometrySample& sample, const StructureUse& use) {
  const auto size = static_cast<double>(sample.size);
  const bool fits_badly = sample.boxes_per_hit() > kBadFit;
  const double build = kBuild * size;
  const double trace = use.rays * kRay * std::log2(2.0 + size);
  const auto seconds = [&](const Price& price) { return build * price.build + trace * (fits_badly ? price.overlap : price.trace); };
  const Price& best = *std::ranges::min_element(prices, {}, seconds);
  double next = std::numeric_limits<double>::infinity();
  for (const Price& price : prices)
    if (&price != &best) next = std::min(next, seconds(price));
  StructureChoice choice;
  choice.structure = canonical_spec(best.structure);
  const bool follows = use.kind == StructureUse::Kind::moving;
  choice.reason = short_count(size) + ' ' + std::string(name_of(sample.kind)) + ", " + one_decimal(sample.boxes_per_hit()) +
                  " boxes met for one hit, " + short_count(use.rays) + " rays " + (follows ? "between movements" : "for one build") + ": " +
                  percent(build * best.build / seconds(best)) + " of the time would go into " +
                  (follows ? "following the geometry" : "building");
  if (std::isfinite(next)) choice.reason += "; the next best would take " + percent(next / seconds(best) - 1.0) + " longer";
  return choice;
}

}  // namespace

StructureChoice choose_structure(const GeometrySample& sample, const StructureUse& use) {
  const bool has_triangles = sample.kind == GeometryKind::triangles;
  switch (use.kind) {
    case StructureUse::Kind::memory:
      return {
          canonical_spec("bvh:cost=equation-2,leaf-size=32"),
          "memory is short: leaves of many primitives take some 43 bytes a primitive, where fast takes 66 to 80 and a kd-tree 43 to 180"};
    case StructureUse::Kind::moving:
      return has_triangles ? cheapest(kMoving, sample, use) : cheapest(kMovingOthers, sample, use);
    case StructureUse::Kind::still:
      return has_triangles ? cheapest(kStill, sample, use) : cheapest(kStillOthers, sample, use);
  }
  return {};
}

StructureChoice choose_structure(const GeometryPointer& geometry, const StructureUse& use) {
  return choose_structure(sample_geometry(geometry), use);
}

StructureUse use_of(std::string_view spec) {
  const Spec parsed = Spec::parse(spec);
  StructureUse use;
  const std::string& kind = parsed.value("use");
  if (kind == "moving") use.kind = StructureUse::Kind::moving;
  if (kind == "memory") use.kind = StructureUse::Kind::memory;
  constexpr double kStillRays = 1e8;   // a picture of a million pixels with some ten paths each
  constexpr double kMovingRays = 2e6;  // a frame of one ray a pixel
  const int millions = parsed.number("rays");
  use.rays = millions > 0 ? 1e6 * millions : use.kind == StructureUse::Kind::moving ? kMovingRays : kStillRays;
  return use;
}

}  // namespace grove
