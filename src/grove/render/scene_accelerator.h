#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "grove/registry/registry.h"
#include "grove/scene/scene.h"

namespace grove {

/// The structures over a whole scene: one over the only object when it stands untransformed, otherwise one per object and one of the
/// same spec over the instances. Immutable; any number of threads may trace it. Keeps the geometry alive, not the Scene.
class SceneAccelerator {
 public:
  /// Builds in parallel in the caller's oneTBB arena. Throws UsageError for a bad spec.
  SceneAccelerator(const Scene& scene, std::string_view spec);

  /// What to trace: hits name (instance, geometry = part, primitive). Without a top level `instance` is kInvalidId.
  [[nodiscard]] const Accelerator& top() const { return *top_; }
  [[nodiscard]] bool has_top_level() const { return !objects_.empty(); }
  /// The structures that the instances of a top level refer to, by number of the scene's object; empty without a top level.
  [[nodiscard]] std::span<const std::shared_ptr<const Accelerator>> objects() const { return objects_; }
  [[nodiscard]] const std::string& spec() const { return top_->spec(); }
  /// Sums over all levels, each object once (primitives: those of the objects, references: with those to instances); depth is the deepest
  /// way through both; the cost is that of the top level, plus each instance's object by the chance that a ray meets it.
  [[nodiscard]] const StructureStatistics& statistics() const { return statistics_; }

  /// The quality of the structure over the object with the most primitives (the first of equals): overlap is measured against surfaces, which a top
  /// level has none of. Costs as much as Accelerator::measure_quality.
  [[nodiscard]] StructureQuality measure_quality() const;

  /// The instance of the scene that a hit lies on.
  [[nodiscard]] static std::uint32_t instance_of(const Hit& hit) { return hit.instance == kInvalidId ? 0 : hit.instance; }

 private:
  std::unique_ptr<Accelerator> top_;
  std::vector<std::shared_ptr<const Accelerator>> objects_;
  StructureStatistics statistics_;
};

}  // namespace grove
