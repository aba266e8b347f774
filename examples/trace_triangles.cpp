// Trace a ray at your own triangles.

#include <cstdio>
#include <utility>

#include "grove/registry/registry.h"

int main() {
  // A unit square at z = -2, as two triangles over shared vertices.
  grove::TriangleMesh square({{0, 0, -2}, {1, 0, -2}, {1, 1, -2}, {0, 1, -2}}, {{0, 1, 2}, {0, 2, 3}});
  const auto accelerator = grove::build(std::move(square));

  const grove::Hit hit = accelerator->intersect(grove::Ray{.origin = {0.25F, 0.75F, 0}, .direction = {0, 0, -1}});
  if (hit) std::printf("triangle %u at t = %g, u = %g, v = %g\n", hit.primitive, hit.t, hit.u, hit.v);
}
