#include "grove/lab/view/scene_walks.h"

#include "grove/registry/registry.h"

namespace grove {

namespace {

/// The closest hit after step i of a walk that found `hit`: what the next step tells was before it.
float closest_after(const TraversalRecord& record, std::size_t i, const Hit& hit) {
  if (i + 1 < record.steps.size()) return record.steps[i + 1].closest;
  return hit ? hit.t : record.steps[i].closest;
}

}  // namespace

/// What is being recorded.
struct SceneWalks::Log {
  TraversalRecord top;
  TraversalRecord object;
  /// Steps in objects, with how many steps of the top structure came before.
  struct Nested {
    std::size_t position;
    SceneStep step;
  };
  std::vector<Nested> nested;
};

/// An object of one instance, which tells the log what rays do in it.
class SceneWalks::TellingObject final : public Traceable {
 public:
  TellingObject(std::shared_ptr<const Accelerator> object, std::uint32_t instance, Log& log)
      : object_(std::move(object)), instance_(instance), log_(log) {}

  [[nodiscard]] Box bounds() const override { return object_->bounds(); }

  [[nodiscard]] Hit closest_hit(const Ray& ray, TraversalCounts* /*counts*/) const override {
    const Hit hit = object_->record_steps(ray, log_.object);
    for (std::size_t i = 0; i < log_.object.steps.size(); ++i)
      log_.nested.push_back({log_.top.steps.size(), {log_.object.steps[i], closest_after(log_.object, i, hit), instance_}});
    return hit;
  }

  [[nodiscard]] bool any_hit(const Ray& ray, TraversalCounts* counts) const override { return object_->any_hit(ray, counts); }

  // Views show rays that take every hit.
  [[nodiscard]] Hit closest_hit(const Ray& ray, const HitFilter& filter) const override { return object_->closest_hit(ray, filter); }
  [[nodiscard]] bool any_hit(const Ray& ray, const HitFilter& filter) const override { return object_->any_hit(ray, filter); }

 private:
  std::shared_ptr<const Accelerator> object_;
  std::uint32_t instance_;
  Log& log_;
};

SceneWalks::SceneWalks(const Scene& scene, const SceneAccelerator& accelerator) : top_(&accelerator.top()), log_(std::make_unique<Log>()) {
  if (!accelerator.has_top_level()) return;
  std::vector<InstanceSet::Instance> instances;
  instances.reserve(scene.instances.size());
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    instances.push_back({std::make_shared<TellingObject>(accelerator.objects()[instance.object], i, *log_), instance.object_to_world});
  }
  own_top_ = build(std::make_shared<const InstanceSet>(std::move(instances)), accelerator.spec());
  top_ = own_top_.get();
}

SceneWalks::~SceneWalks() = default;

Hit SceneWalks::record(const Ray& ray, std::vector<SceneStep>& steps) {
  log_->nested.clear();
  const Hit hit = top_->record_steps(ray, log_->top);
  steps.clear();
  steps.reserve(log_->top.steps.size() + log_->nested.size());
  std::size_t next = 0;
  for (std::size_t i = 0; i <= log_->top.steps.size(); ++i) {
    for (; next < log_->nested.size() && log_->nested[next].position == i; ++next) steps.push_back(log_->nested[next].step);
    if (i < log_->top.steps.size()) steps.push_back({log_->top.steps[i], closest_after(log_->top, i, hit)});
  }
  return hit;
}

}  // namespace grove
