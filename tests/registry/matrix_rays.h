#pragma once

#include <cstdint>
#include <vector>

#include "registry/matrix_geometry.h"

namespace grove::test {

/// Rays for a geometry: random ones, and ones that aim at what goes wrong. At vertices, edges and centres; in the planes of primitives'
/// boxes and along their edges; with zero, negative-zero and denormal components; with limits on hits exactly; not traceable at all.
/// About 20 * `scale` rays, the same for the same seed.
[[nodiscard]] std::vector<Ray> matrix_rays(const GeometryPointer& geometry, std::size_t scale, std::uint64_t seed);

}  // namespace grove::test
