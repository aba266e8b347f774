#pragma once

#include <string>

#include "grove/registry/geometry_sample.h"
#include "grove/registry/registry.h"

namespace grove {

/// What a structure is wanted for: the keys of the family `auto`.
struct StructureUse {
  enum class Kind : std::uint8_t {
    still,   ///< built once, then traced
    moving,  ///< primitives move between one batch of rays and the next, which the structure follows
    memory   ///< memory is short
  };
  Kind kind = Kind::still;
  /// Rays that are traced until the structure is built anew or has to follow its geometry.
  double rays = 1e8;
};

struct StructureChoice {
  std::string structure;  ///< canonical spec
  std::string reason;     ///< one sentence, with the figures that decided
};

/// Chooses a structure for a geometry by what a look at some of its primitives tells and by what building and tracing have been measured to take
/// (docs/auto.md), without building any. The same choice for the same geometry.
[[nodiscard]] StructureChoice choose_structure(const GeometryPointer& geometry, const StructureUse& use);

/// The same from a sample that has been taken.
[[nodiscard]] StructureChoice choose_structure(const GeometrySample& sample, const StructureUse& use);

/// The use that a spec of the family `auto` names. Throws UsageError for a bad spec.
[[nodiscard]] StructureUse use_of(std::string_view spec);

}  // namespace grove
