#include "grove/build/quality/surface_points.h"

#include <algorithm>

#include "grove/base/huge_vector.h"
#include "grove/base/parallel.h"
#include "grove/base/random.h"

namespace grove {
namespace {

constexpr std::size_t kGrain = 16384;

// Element i: the area of all primitives up to and with i.
template <SampledGeometry G>
HugeVector<double> cumulative_areas(const G& geometry) {
  HugeVector<double> areas(geometry.size());
  parallel_for(geometry.size(), kGrain, [&](std::size_t i) { areas[i] = geometry.surface_area(i); });
  // Summed one after another, so that the rounding does not depend on the number of threads.
  double sum = 0.0;
  for (double& area : areas) area = sum += area;
  return areas;
}

}  // namespace

template <SampledGeometry G>
std::vector<SurfacePoint> sample_surface(const G& geometry, std::size_t count, std::uint64_t seed) {
  const HugeVector<double> areas = cumulative_areas(geometry);
  if (areas.empty() || !(areas.back() > 0.0)) return {};
  std::vector<SurfacePoint> points(count);
  parallel_for(count, kGrain, [&](std::size_t i) {
    Random random(mix_bits(seed) + i);
    const double place = (static_cast<double>(i) + random.next_float()) / static_cast<double>(count) * areas.back();
    // The first primitive whose area reaches beyond the place; one without area never is.
    const auto found = std::min(std::upper_bound(areas.begin(), areas.end(), place), areas.end() - 1);
    const auto primitive = static_cast<std::size_t>(found - areas.begin());
    const double before = primitive > 0 ? areas[primitive - 1] : 0.0;
    // How far into the primitive the place lies is uniform too, and spreads the points of a large one evenly.
    const double u = std::clamp((place - before) / (areas[primitive] - before), 0.0, 1.0);
    points[i] = {geometry.surface_point(primitive, u, random.next_float()), static_cast<std::uint32_t>(primitive)};
  });
  return points;
}

template std::vector<SurfacePoint> sample_surface(const TriangleMesh&, std::size_t, std::uint64_t);
template std::vector<SurfacePoint> sample_surface(const SphereSet&, std::size_t, std::uint64_t);

}  // namespace grove
