#include "grove/render/scene_accelerator.h"

#include <algorithm>
#include <span>
#include <utility>

#include "grove/base/parallel.h"
#include "grove/base/timer.h"

namespace grove {
namespace {

GeometryPointer geometry_of(const Object& object) {
  return std::visit([]<typename Set>(const std::shared_ptr<Set>& set) -> GeometryPointer { return std::shared_ptr<const Set>(set); },
                    object.geometry);
}

void add_histogram(std::vector<std::uint64_t>& sum, const std::vector<std::uint64_t>& part) {
  if (sum.size() < part.size()) sum.resize(part.size());
  for (std::size_t i = 0; i < part.size(); ++i) sum[i] += part[i];
}

// What tracing one ray costs: the top level, and each instance's object as often as a ray that meets the top level meets the
// instance (the ratio of areas, as within a structure). Areas in double: they overflow a float beyond 1e19.
double two_level_cost(const Scene& scene, std::span<const std::shared_ptr<const Accelerator>> objects, const Accelerator& top,
                      const InstanceSet& instances) {
  const auto area = [](const Box& box) {
    if (box.is_empty()) return 0.0;
    const glm::dvec3 d = glm::dvec3(box.upper) - glm::dvec3(box.lower);
    return d.x * (d.y + d.z) + d.y * d.z;
  };
  const double whole = area(top.bounds());
  double cost = top.statistics().expected_cost;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    if (instances.bounds(i).is_empty()) continue;
    const double chance = whole > 0.0 ? area(instances.bounds(i)) / whole : 1.0;
    cost += chance * objects[scene.instances[i].object]->statistics().expected_cost;
  }
  return cost;
}

}  // namespace

SceneAccelerator::SceneAccelerator(const Scene& scene, std::string_view spec) {
  if (scene.objects.size() == 1 && scene.instances.size() == 1 && scene.instances.front().object_to_world.is_identity()) {
    top_ = build(geometry_of(scene.objects.front()), spec);
    statistics_ = top_->statistics();
    return;
  }
  const Timer timer;
  std::vector<std::unique_ptr<Accelerator>> built(scene.objects.size());
  parallel_for(scene.objects.size(), 1, [&](std::size_t i) { built[i] = build(geometry_of(scene.objects[i]), spec); });
  for (std::unique_ptr<Accelerator>& object : built) objects_.push_back(std::move(object));
  std::vector<InstanceSet::Instance> instances;
  instances.reserve(scene.instances.size());
  for (const Instance& instance : scene.instances) instances.push_back({objects_[instance.object], instance.object_to_world});
  const auto top_level = std::make_shared<const InstanceSet>(std::move(instances));
  top_ = build(top_level, spec);

  statistics_ = top_->statistics();
  statistics_.expected_cost = two_level_cost(scene, objects_, *top_, *top_level);
  statistics_.primitives = 0;
  std::uint32_t deepest = 0;
  for (const std::shared_ptr<const Accelerator>& object : objects_) {
    const StructureStatistics& part = object->statistics();
    statistics_.primitives += part.primitives;
    statistics_.references += part.references;
    statistics_.nodes += part.nodes;
    statistics_.leaves += part.leaves;
    statistics_.bytes += part.bytes;
    deepest = std::max(deepest, part.depth);
    statistics_.largest_leaf = std::max(statistics_.largest_leaf, part.largest_leaf);
    add_histogram(statistics_.leaf_sizes, part.leaf_sizes);
    add_histogram(statistics_.depths, part.depths);
  }
  statistics_.depth += deepest;
  statistics_.build_seconds = timer.seconds();  // objects are built side by side
}

StructureQuality SceneAccelerator::measure_quality() const {
  if (!has_top_level()) return top_->measure_quality();
  const auto size = [](const std::shared_ptr<const Accelerator>& object) { return object->statistics().primitives; };
  return (*std::ranges::max_element(objects_, {}, size))->measure_quality();
}

}  // namespace grove
