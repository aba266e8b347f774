#include "grove/lab/comparison_workload.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "grove/base/error.h"

namespace grove {
namespace {

std::vector<RaySet> make_sets(RayKind kind, const Scene& scene, const SceneAccelerator& accelerator, const Camera& camera,
                              const WorkloadSettings& settings) {
  if (kind == RayKind::recorded) return recorded_rays(scene, accelerator, camera, settings);
  std::vector<RaySet> sets;
  sets.push_back(ray_set(std::string(name_of(kind)), make_rays(kind, scene, accelerator, camera, settings), query_of(kind)));
  return sets;
}

}  // namespace

std::vector<ComparisonWorkload> make_workloads(const Scene& scene, const ComparisonWorkloadSettings& settings,
                                               const std::function<bool()>& made) {
  const Camera camera = workload_camera(scene, settings.camera);
  const SceneAccelerator accelerator(scene, kDefaultSpec);
  const SceneAccelerator brute(scene, "brute");
  const std::uint64_t primitives = std::max<std::uint64_t>(1, scene.primitive_count());
  const std::uint64_t brute_rays = std::max<std::uint64_t>(1, kBruteTests / primitives);
  std::vector<ComparisonWorkload> workloads;
  for (const RayKind kind : settings.kinds) {
    try {
      for (RaySet& set : make_sets(kind, scene, accelerator, camera, settings.workload)) {
        ComparisonWorkload& workload = workloads.emplace_back();
        workload.set = std::move(set);
        workload.brute_stride = (workload.set.size() + brute_rays - 1) / brute_rays;
        if (workload.brute_stride > 1) workload.sample = workload.set.every(workload.brute_stride);
        workload.reference.emplace(brute.top(), primitives, workload.set, settings.check_budget);
      }
    } catch (const std::exception& exception) {
      ComparisonWorkload& workload = workloads.emplace_back();
      workload.set.name = name_of(kind);
      workload.error = reason_of(exception);
    }
    if (!made()) break;
  }
  return workloads;
}

}  // namespace grove
