#pragma once

#include <algorithm>
#include <memory>
#include <variant>

#include "grove/registry/registry.h"
#include "grove/scene/scene.h"

namespace grove {

/// The object of a scene that has most primitives, the first of equals; null where there is none.
[[nodiscard]] inline const Object* largest_object(const Scene& scene) {
  const auto largest = std::max_element(scene.objects.begin(), scene.objects.end(),
                                        [](const Object& a, const Object& b) { return a.primitive_count() < b.primitive_count(); });
  return largest == scene.objects.end() ? nullptr : &*largest;
}

/// What a structure is built over.
[[nodiscard]] inline GeometryPointer geometry_of(const Object& object) {
  return std::visit([]<typename Set>(const std::shared_ptr<Set>& set) -> GeometryPointer { return std::shared_ptr<const Set>(set); },
                    object.geometry);
}

}  // namespace grove
