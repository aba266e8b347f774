#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "grove/base/progress.h"
#include "grove/lab/machine.h"
#include "grove/lab/workload.h"
#include "grove/registry/update.h"

namespace grove {

struct AnimationSettings {
  std::string structure = "bvh";
  std::vector<UpdatePolicy> policies{UpdatePolicy::automatic, UpdatePolicy::refit, UpdatePolicy::rotate, UpdatePolicy::rebuild};
  unsigned frames = 100;
  RayKind rays = RayKind::diffuse;
  WorkloadSettings workload{std::size_t{1} << 16, 1};
};

/// One policy in one frame.
struct AnimationRow {
  unsigned frame = 0;
  double time = 0.0;  ///< of the scene, from 0 to 1
  UpdatePolicy policy = UpdatePolicy::automatic;
  UpdateReport update;
  double trace_seconds = 0.0;
  double mrays_per_s = 0.0;
  double nodes_per_ray = 0.0;
  double tests_per_ray = 0.0;
  std::uint64_t mismatches = 0;  ///< rays whose hit is not that of a structure built anew, bit for bit
};

struct Animation {
  std::string scene;
  std::string structure;
  RayKind rays = RayKind::diffuse;
  std::size_t ray_count = 0;
  std::uint64_t primitives = 0;
  Machine machine;
  std::vector<AnimationRow> rows;  ///< by frame, then in the order of the policies
};

/// The scene as it is at a time from 0 to 1: one object of triangles that are the same at all times but for where their vertices are.
using MovingScene = std::function<Scene(double time)>;

/// The moving scene that `source` names, "builtin:NAME?…" without a time. Throws UsageError for what does not move.
[[nodiscard]] MovingScene moving_scene(const std::string& source);

/// Plays a moving scene with one structure for each policy side by side: in each frame every structure is updated and then traced with
/// the same rays, one policy after the other, so that what disturbs the machine disturbs all of them; every hit is checked. `update.rays` of each
/// update is the number of rays. Runs in the caller's oneTBB arena. Progress counts frames; when `progress.stop` asks, returns
/// the frames that are finished. Throws InputError where the scene's triangles change.
[[nodiscard]] Animation animate(const MovingScene& scene, const AnimationSettings& settings, const ProgressReporter& progress = {});

}  // namespace grove
