#include "grove/render/scene_accelerator.h"

#include <algorithm>
#include <span>
#include <utility>

#include "grove/base/check.h"
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

// In double: areas overflow a float beyond 1e19.
double area(const Box& box) {
  if (box.is_empty()) return 0.0;
  const glm::dvec3 d = glm::dvec3(box.upper) - glm::dvec3(box.lower);
  return d.x * (d.y + d.z) + d.y * d.z;
}

// The chance that a ray which meets all of them meets instance i: the ratio of areas, as within a structure.
double chance_of(const InstanceSet& instances, std::size_t i, double whole_area) {
  if (instances.bounds(i).is_empty()) return 0.0;
  return whole_area > 0.0 ? area(instances.bounds(i)) / whole_area : 1.0;
}

// How many of an object's instances a ray meets.
std::vector<double> entries_of_objects(const Scene& scene, const InstanceSet& instances, const Box& bounds) {
  std::vector<double> entries(scene.objects.size(), 0.0);
  const double whole = area(bounds);
  for (std::size_t i = 0; i < instances.size(); ++i) entries[scene.instances[i].object] += chance_of(instances, i, whole);
  return entries;
}

}  // namespace

SceneAccelerator::SceneAccelerator(const Scene& scene, std::string_view spec, TopLevel top_level) {
  if (top_level == TopLevel::where_needed && scene.objects.size() == 1 && scene.instances.size() == 1 &&
      scene.instances.front().object_to_world.is_identity()) {
    top_ = build(geometry_of(scene.objects.front()), spec);
    statistics_ = top_->statistics();
    top_cost_ = {statistics_.expected_cost, statistics_.expected_cost};
    return;
  }
  const Timer timer;
  std::vector<std::unique_ptr<Accelerator>> built(scene.objects.size());
  parallel_for(scene.objects.size(), 1, [&](std::size_t i) { built[i] = build(geometry_of(scene.objects[i]), spec); });
  objects_.reserve(built.size());
  updatable_.reserve(built.size());
  for (std::unique_ptr<Accelerator>& object : built) {
    updatable_.push_back(object.get());
    objects_.push_back(std::move(object));
  }
  std::vector<InstanceSet::Instance> instances;
  instances.reserve(scene.instances.size());
  for (const Instance& instance : scene.instances) instances.push_back({objects_[instance.object], instance.object_to_world});
  instances_ = std::make_shared<InstanceSet>(std::move(instances));
  top_ = build(std::shared_ptr<const InstanceSet>(instances_), spec);

  statistics_ = top_->statistics();
  top_cost_ = {statistics_.expected_cost, statistics_.expected_cost};
  object_costs_.reserve(objects_.size());
  for (const auto& object : objects_) object_costs_.push_back({object->statistics().expected_cost, object->statistics().expected_cost});
  statistics_.expected_cost = whole_cost(scene).now;
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

SceneUpdateReport SceneAccelerator::update(const Scene& scene, const SceneChanges& changes, UpdatePolicy policy, double rays) {
  const Timer timer;
  SceneUpdateReport report;
  if (!has_top_level()) {
    GROVE_CHECK(changes.instances.empty());
    if (!changes.objects.empty()) {
      report.objects.push_back(top_->update({policy, rays}));
      note(report.objects.front(), top_cost_);
    }
  } else if (changes.has_geometry()) {
    const std::vector<double> entries = entries_of_objects(scene, *instances_, top_->bounds());
    report.objects.resize(changes.objects.size());
    parallel_for(changes.objects.size(), 1, [&](std::size_t i) {
      const std::uint32_t object = changes.objects[i];
      report.objects[i] = updatable_[object]->update({policy, rays * entries[object]});
    });
    std::vector<bool> has_moved(scene.instances.size(), false);
    for (const std::uint32_t i : changes.instances) has_moved[i] = true;
    std::vector<bool> is_changed(scene.objects.size(), false);
    for (std::size_t i = 0; i < changes.objects.size(); ++i) {
      is_changed[changes.objects[i]] = true;
      note(report.objects[i], object_costs_[changes.objects[i]]);
    }
    std::vector<std::uint32_t> moved;
    moved.reserve(scene.instances.size());
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
      if (!has_moved[i] && !is_changed[scene.instances[i].object]) continue;
      instances_->move_instance(i, scene.instances[i].object_to_world);
      moved.push_back(i);
    }
    if (!moved.empty()) {
      report.top = top_->update({policy, rays, moved});
      note(*report.top, top_cost_);
    }
  }
  const Cost cost = whole_cost(scene);
  report.cost_growth = cost.built > 0.0 ? cost.now / cost.built : 1.0;
  report.seconds = timer.seconds();
  return report;
}

void SceneAccelerator::note(const UpdateReport& report, Cost& cost) {
  cost.now = report.cost;
  cost.built = report.method == UpdateMethod::rebuild ? report.cost : report.built_cost;
}

// What tracing one ray costs: the top level, and each instance's object as often as a ray that meets the top level meets the instance.
SceneAccelerator::Cost SceneAccelerator::whole_cost(const Scene& scene) const {
  Cost cost = top_cost_;
  if (!has_top_level()) return cost;
  const std::vector<double> entries = entries_of_objects(scene, *instances_, top_->bounds());
  for (std::size_t i = 0; i < object_costs_.size(); ++i) {
    cost.now += entries[i] * object_costs_[i].now;
    cost.built += entries[i] * object_costs_[i].built;
  }
  return cost;
}

StructureQuality SceneAccelerator::measure_quality() const {
  if (!has_top_level()) return top_->measure_quality();
  const auto size = [](const std::shared_ptr<const Accelerator>& object) { return object->statistics().primitives; };
  return (*std::ranges::max_element(objects_, {}, size))->measure_quality();
}

}  // namespace grove
