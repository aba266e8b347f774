#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "grove/geometry/ray.h"
#include "grove/registry/registry.h"

namespace grove {

enum class ScatteredPrimitive : std::uint8_t { spheres, triangles };

/// "spheres", "triangles".
[[nodiscard]] std::string_view name_of(ScatteredPrimitive primitive);

/// Primitives of one size in the unit cube, evenly or more and more in one corner: the measure of how uneven a scene is has one number. Coordinates
/// of their centres are u^skew with u uniform in [0, 1); spheres fill 1 % of the cube at skew 1, triangles have edges of twice their radius.
struct ScatterSettings {
  ScatteredPrimitive primitive = ScatteredPrimitive::spheres;
  std::size_t count = 10000;
  double skew = 1.0;
  std::uint64_t seed = 1;
};

/// The same settings give the same geometry on every machine, as far as its pow rounds alike.
[[nodiscard]] GeometryPointer scatter(const ScatterSettings& settings);

/// The same with every `stride`-th primitive, from number 0 on, where another seed puts it. `moved` becomes their numbers.
[[nodiscard]] GeometryPointer scatter_again(const ScatterSettings& settings, std::size_t stride, std::uint64_t seed,
                                            std::vector<std::uint32_t>& moved);

/// Rays with origins uniform in the box and uniform directions, without end.
[[nodiscard]] std::vector<Ray> rays_inside(const Box& box, std::size_t count, std::uint64_t seed);

/// Lines that meet the box, distributed uniformly (isotropic and homogeneous: every line as likely as any other), as the surface-area heuristic takes rays to be. They start
/// outside of it, without end.
[[nodiscard]] std::vector<Ray> lines_through(const Box& box, std::size_t count, std::uint64_t seed);

}  // namespace grove
