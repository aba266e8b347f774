#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "grove/geometry/geometry_concept.h"

namespace grove {

/// The primitives of a geometry that a structure over it does not refer to, as they could not be hit when it was built, or were added since. When one of them
/// can be hit, no refit is enough.
class LeftOutPrimitives {
 public:
  /// Takes down which they are: tell_references(tell) calls tell(primitive) for each reference of the structure. O(primitives + references).
  template <typename TellReferences>
  void take(std::size_t primitive_count, const TellReferences& tell_references) {
    std::vector<bool> is_referenced(primitive_count, false);
    tell_references([&](std::uint32_t primitive) { is_referenced[primitive] = true; });
    numbers_.clear();
    for (known_ = 0; known_ < primitive_count; ++known_)
      if (!is_referenced[known_]) numbers_.push_back(known_);
  }

  /// Those that were added to the geometry since, which the structure does not know.
  void add_up_to(std::size_t primitive_count) {
    for (; known_ < primitive_count; ++known_) numbers_.push_back(known_);
  }

  /// Whether any of them can be hit now.
  template <Geometry G>
  [[nodiscard]] bool appeared(const G& geometry) const {
    for (const std::uint32_t i : numbers_)
      if (!geometry.bounds(i).is_empty()) return true;
    return false;
  }

 private:
  std::uint32_t known_ = 0;
  std::vector<std::uint32_t> numbers_;
};

}  // namespace grove
