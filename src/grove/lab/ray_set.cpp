#include "grove/lab/ray_set.h"

#include <utility>

#include "grove/base/check.h"

namespace grove {

RaySet RaySet::every(std::size_t stride) const {
  RaySet result;
  result.name = name;
  result.rays.reserve((rays.size() + stride - 1) / stride);
  for (std::size_t i = 0; i < rays.size(); i += stride) result.rays.push_back(rays[i]);
  result.closest_count = (closest_count + stride - 1) / stride;
  return result;
}

RaySet ray_set(std::string name, std::vector<Ray> rays, Query query) {
  const std::size_t closest_count = query == Query::closest ? rays.size() : 0;
  return {std::move(name), std::move(rays), closest_count};
}

void trace(const Accelerator& accelerator, const RaySet& set, std::span<Hit> hits) {
  GROVE_CHECK(hits.size() == set.size());
  if (set.closest_count > 0) trace(accelerator, Query::closest, set.closest(), hits.first(set.closest_count));
  if (set.closest_count < set.size()) trace(accelerator, Query::any, set.any(), hits.subspan(set.closest_count));
}

}  // namespace grove
