#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "grove/render/scene_accelerator.h"
#include "grove/scene/scene.h"

namespace grove {

/// A step of a ray through a scene.
struct SceneStep {
  TraversalStep step;
  float closest_after = 0.0F;           ///< distance of the closest hit in that structure after the step, as step.closest before it
  std::uint32_t instance = kInvalidId;  ///< in whose object's structure it is; of the top structure kInvalidId
};

/// Records what rays do in the structures over a scene: in the top one, and in those of the objects of instances. Not for several threads at once.
class SceneWalks {
 public:
  /// Both must stay as they are. Where there is a top level it is built once more, over objects that tell what they do; it is the same tree.
  SceneWalks(const Scene& scene, const SceneAccelerator& accelerator);
  ~SceneWalks();
  SceneWalks(const SceneWalks&) = delete;
  SceneWalks& operator=(const SceneWalks&) = delete;

  /// The closest hit as the scene's accelerator finds it for a ray on its own, and in `steps` all steps in order: those in an object follow the
  /// test of its instance.
  Hit record(const Ray& ray, std::vector<SceneStep>& steps);

 private:
  class TellingObject;
  struct Log;

  const Accelerator* top_;
  std::unique_ptr<Accelerator> own_top_;  // where there is a top level
  std::unique_ptr<Log> log_;
};

}  // namespace grove
