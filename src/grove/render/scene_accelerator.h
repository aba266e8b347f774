#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "grove/registry/registry.h"
#include "grove/scene/animation/scene_changes.h"
#include "grove/scene/scene.h"

namespace grove {

/// When a scene has a structure over its instances.
enum class TopLevel : std::uint8_t {
  where_needed,  ///< not where the only object stands untransformed
  always         ///< for scenes whose instances will move
};

/// How the structures of a scene followed it.
struct SceneUpdateReport {
  /// One for each object whose vertices moved, in the order of SceneChanges; without a top level that is the whole.
  std::vector<UpdateReport> objects;
  /// Where there is a top level and something in it moved.
  std::optional<UpdateReport> top;
  /// By how much a ray has become dearer than it was when each structure was last built as a whole, by expected cost with instances where they are now.
  double cost_growth = 1.0;
  double seconds = 0.0;  ///< wall clock
};

/// The structures over a whole scene: one over the only object when it stands untransformed, otherwise one per object and one of the
/// same spec over the instances. Any number of threads may trace it; it changes only in `update`. Keeps the geometry alive, not the Scene.
class SceneAccelerator {
 public:
  /// Builds in parallel in the caller's oneTBB arena. Throws UsageError for a bad spec.
  SceneAccelerator(const Scene& scene, std::string_view spec, TopLevel top_level = TopLevel::where_needed);

  /// Follows `scene`, the one that this was built from, whose instances and vertices have moved as `changes` says: structures of other objects are not
  /// touched, and the top level is only where something in it moved. UpdatePolicy::automatic is told of each structure what part of `rays`, the number that
  /// will be traced before the next update, is expected to reach it. Nothing is done when nothing moved. Must not run while rays are traced; parallel in
  /// the caller's oneTBB arena. Instances may only have moved when there is a top level.
  SceneUpdateReport update(const Scene& scene, const SceneChanges& changes, UpdatePolicy policy, double rays);

  /// What to trace: hits name (instance, geometry = part, primitive). Without a top level `instance` is kInvalidId.
  [[nodiscard]] const Accelerator& top() const { return *top_; }
  [[nodiscard]] bool has_top_level() const { return !objects_.empty(); }
  /// The structures that the instances of a top level refer to, by number of the scene's object; empty without a top level.
  [[nodiscard]] std::span<const std::shared_ptr<const Accelerator>> objects() const { return objects_; }
  [[nodiscard]] const std::string& spec() const { return top_->spec(); }
  /// Sums over all levels, each object once (primitives: those of the objects, references: with those to instances); depth is the deepest
  /// way through both; the cost is that of the top level, plus each instance's object by the chance that a ray meets it. As built: updates do not change it.
  [[nodiscard]] const StructureStatistics& statistics() const { return statistics_; }

  /// The quality of the structure over the object with the most primitives (the first of equals): overlap is measured against surfaces, which a top
  /// level has none of. Costs as much as Accelerator::measure_quality.
  [[nodiscard]] StructureQuality measure_quality() const;

  /// The instance of the scene that a hit lies on.
  [[nodiscard]] static std::uint32_t instance_of(const Hit& hit) { return hit.instance == kInvalidId ? 0 : hit.instance; }

 private:
  // What a ray costs in a structure: now, and when it was last built as a whole.
  struct Cost {
    double now = 0.0;
    double built = 0.0;
  };

  [[nodiscard]] Cost whole_cost(const Scene& scene) const;
  static void note(const UpdateReport& report, Cost& cost);

  std::unique_ptr<Accelerator> top_;
  std::vector<std::shared_ptr<const Accelerator>> objects_;
  std::vector<Accelerator*> updatable_;  // the same objects
  std::shared_ptr<InstanceSet> instances_;
  Cost top_cost_;
  std::vector<Cost> object_costs_;
  StructureStatistics statistics_;
};

}  // namespace grove
