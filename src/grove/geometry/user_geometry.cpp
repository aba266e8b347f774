#include "grove/geometry/user_geometry.h"

#include <algorithm>

namespace grove {

bool UserGeometry::take_closer(const Hit& candidate, std::uint32_t primitive, const Ray& ray, Hit& hit) {
  if (!(candidate.t >= ray.t_min) || !is_closer(candidate.t, primitive, hit)) return false;
  hit.t = candidate.t;
  hit.u = candidate.u;
  hit.v = candidate.v;
  hit.primitive = primitive;
  return true;
}

bool UserGeometry::intersect_closer(std::size_t i, const Ray& ray, Hit& hit) const {
  Ray shortened = ray;
  shortened.t_max = hit.t;
  Hit candidate;
  return intersect_primitive(i, shortened, candidate) && take_closer(candidate, static_cast<std::uint32_t>(i), ray, hit);
}

std::uint32_t UserGeometry::intersect_primitives(std::span<const std::uint32_t> primitives, const Ray& ray, Hit* hits) const {
  std::uint32_t met = 0;
  for (std::size_t k = 0; k < primitives.size(); ++k)
    met |= (intersect_primitive(primitives[k], ray, hits[k]) ? std::uint32_t{1} : std::uint32_t{0}) << k;
  return met;
}

void UserGeometry::intersect_leaf(std::span<const std::uint32_t> primitives, const PreparedRay& ray, Hit& hit) const {
  for (std::size_t first = 0; first < primitives.size(); first += kMostAtOnce) {
    const auto asked = primitives.subspan(first, std::min(kMostAtOnce, primitives.size() - first));
    Ray shortened = ray;
    shortened.t_max = hit.t;
    Hit candidates[kMostAtOnce];
    const std::uint32_t met = intersect_primitives(asked, shortened, candidates);
    for (std::size_t k = 0; k < asked.size(); ++k)
      if ((met >> k & 1U) != 0) take_closer(candidates[k], asked[k], ray, hit);
  }
}

}  // namespace grove
