#include "grove/geometry/user_geometry.h"

namespace grove {

bool UserGeometry::intersect_closer(std::size_t i, const Ray& ray, Hit& hit) const {
  Ray shortened = ray;
  shortened.t_max = hit.t;
  Hit candidate;
  if (!intersect_primitive(i, shortened, candidate)) return false;
  const auto id = static_cast<std::uint32_t>(i);
  if (!(candidate.t >= ray.t_min) || !is_closer(candidate.t, id, hit)) return false;
  hit.t = candidate.t;
  hit.u = candidate.u;
  hit.v = candidate.v;
  hit.primitive = id;
  return true;
}

}  // namespace grove
