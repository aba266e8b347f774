#pragma once

#include <vector>

#include "grove/build/primitive_reference.h"

namespace grove::testing {

/// References numbered in the order of the boxes.
inline ReferenceList references_to(const std::vector<Box>& boxes) {
  ReferenceList list;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    list.references.push_back(make_reference(boxes[i], i));
    list.bounds.grow(boxes[i]);
  }
  return list;
}

/// A cube with sides of `size` around a point.
inline Box cube(const Vec3& centre, float size) {
  return {centre - 0.5F * size, centre + 0.5F * size};
}

}  // namespace grove::testing
