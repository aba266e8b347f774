#pragma once

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <optional>
#include <string>

#include "console.h"
#include "grove/render/scene_accelerator.h"
#include "grove/scene/animation/animated_scene.h"
#include "grove/scene/scene.h"
#include "options.h"

namespace grove::app {

/// Calls `work` with as many threads as asked for, and returns what it returns.
template <typename Work>
auto with_threads(std::optional<unsigned> threads, const Work& work) {
  if (!threads) return work();
  // The arena decides how many threads work together; the limit lets oneTBB start more of them than the machine has.
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, *threads);
  oneapi::tbb::task_arena arena(static_cast<int>(*threads));
  return arena.execute(work);
}

/// Threads that work in the caller's arena.
[[nodiscard]] unsigned arena_threads();

/// Loads a scene; says what is in it, and warns of what was left out.
[[nodiscard]] Scene load(const std::string& source, const Console& console);

/// The same with one of its animations; see load_animated_scene.
[[nodiscard]] AnimatedScene load_animated(const std::string& source, const std::string& animation, const Console& console);

/// A built structure, and how long that took by the clock.
struct BuiltStructure {
  SceneAccelerator accelerator;
  StructureStatistics statistics;  ///< with build_seconds as measured over all levels
};

/// Builds a structure over a scene, and says how it went.
[[nodiscard]] BuiltStructure build_structure(const Scene& scene, const std::string& spec, const Console& console);

/// Gives up what only shading needs: per-vertex attributes, materials, textures and images.
void drop_shading_data(Scene& scene);

}  // namespace grove::app
