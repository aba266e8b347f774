#pragma once

#include <algorithm>

#include "grove/scene/scene.h"

namespace grove {

/// The object of a scene that has most primitives, the first of equals; null where there is none.
[[nodiscard]] inline const Object* largest_object(const Scene& scene) {
  const auto largest = std::max_element(scene.objects.begin(), scene.objects.end(),
                                        [](const Object& a, const Object& b) { return a.primitive_count() < b.primitive_count(); });
  return largest == scene.objects.end() ? nullptr : &*largest;
}

}  // namespace grove
