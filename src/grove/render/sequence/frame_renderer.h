#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "grove/render/prepared_scene.h"
#include "grove/render/render.h"
#include "grove/render/scene_accelerator.h"
#include "grove/scene/animation/animated_scene.h"

namespace grove {

/// When a picture is taken, in seconds of the scene.
struct Exposure {
  double time = 0.0;
  /// For how long the shutter is open from then on; 0 is no motion blur.
  double duration = 0.0;
  /// At how many times in between the scene is looked at; no more than samples per pixel.
  std::uint32_t times = 1;
};

/// A picture, and what it took to have the scene and its structures at its time.
struct RenderedFrame {
  RenderResult picture;
  bool is_built = false;              ///< the structures were built for it, as for the first
  std::uint32_t moved_instances = 0;  ///< over all times of the exposure
  std::uint32_t moved_objects = 0;    ///< whose vertices moved
  SceneUpdateReport update;           ///< of the last time; seconds are summed over all times
  double build_seconds = 0.0;         ///< building, for the first
  double pose_seconds = 0.0;          ///< moving nodes and vertices
};

/// Makes pictures of a scene that moves, one after the other, with structures that follow it: they are built once and then updated as the policy says.
///
/// Motion blur is the accumulation buffer's (Haeberli and Akeley 1990, "The Accumulation Buffer: Hardware Support for High-Quality Rendering"): the scene is
/// put to the middle of each of `Exposure::times` equal parts of the exposure in turn, structures follow, and each time takes an equal share of each pixel's
/// samples, in order of their number, into the one film. That costs an update for each time, and shows as many copies of what moves as there are times.
///
/// As structures do not change what rays hit, pictures depend on neither the policy nor the frames before, bit for bit. Not for several threads at once.
class FrameRenderer {
 public:
  /// The scene must outlive this; it is left at the time of the last picture. Throws UsageError for a bad spec.
  FrameRenderer(AnimatedScene& scene, std::string_view spec, UpdatePolicy policy);

  /// Takes a picture, as `render` does. `viewpoint` may give another camera for each time. Throws UsageError for impossible settings, among them those for a
  /// part of a picture together with motion blur. When the stop token asks, the picture that comes back is not whole.
  [[nodiscard]] RenderedFrame render(RenderSettings settings, const Exposure& exposure, const ProgressReporter& progress = {},
                                     const std::function<Camera(double time)>& viewpoint = {});

  /// Nothing before the first picture.
  [[nodiscard]] const SceneAccelerator* accelerator() const { return accelerator_.get(); }

 private:
  /// Moves the scene to a time and has the structure follow. Returns what moved.
  SceneChanges follow(double time, RenderedFrame& frame);
  /// Has tables of surfaces, materials and lights for where the scene is after these changes. Returns the seconds that it took.
  double prepare(const SceneChanges& changes, LightSampling sampling);

  AnimatedScene& scene_;
  std::string spec_;
  UpdatePolicy policy_;
  std::unique_ptr<SceneAccelerator> accelerator_;
  std::unique_ptr<PreparedScene> world_;
  double rays_ = 0.0;  // that were traced from the last update to this one
};

}  // namespace grove
