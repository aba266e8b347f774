#pragma once

#include <concepts>
#include <type_traits>

#include "grove/math/box.h"

namespace grove {

/// A convex body that a hierarchy can be made of, as plain data.
template <typename V>
concept BoundingVolume = std::is_trivially_copyable_v<V> && requires(const V& volume, const glm::dvec3& point) {
  { volume.half_area() } -> std::same_as<float>;
  { volume.contains(point) } -> std::same_as<bool>;
  { volume.bounds() } -> std::same_as<Box>;
};

}  // namespace grove
