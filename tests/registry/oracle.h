#pragma once

#include <gtest/gtest.h>

#include "registry/matrix_rays.h"

namespace grove::test {

/// Expects the hits of brute force over the geometry as it is now, bit for bit, on rays of all kinds.
inline void expect_hits_of_brute_force(const Accelerator& structure, const GeometryPointer& geometry, std::uint64_t seed) {
  const auto oracle = build(geometry, "brute");
  std::size_t differences = 0;
  for (const Ray& ray : matrix_rays(geometry, 40, seed)) {
    const Hit expected = oracle->intersect(ray);
    if (!same_bits(structure.intersect(ray), expected) || structure.occluded(ray) != static_cast<bool>(expected)) ++differences;
  }
  EXPECT_EQ(differences, 0U);
}

}  // namespace grove::test
