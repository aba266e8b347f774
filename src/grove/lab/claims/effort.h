#pragma once

#include <cstddef>
#include <stop_token>
#include <string>
#include <vector>

#include "grove/lab/scattered_geometry.h"
#include "grove/lab/structure_trial.h"
#include "grove/lab/workload.h"
#include "grove/scene/scene.h"

namespace grove {

/// How much an experiment may take.
struct Effort {
  /// A few seconds for each claim in place of about a minute.
  bool quick = false;
  std::stop_token stop = {};

  template <typename T>
  [[nodiscard]] T choose(T if_quick, T if_full) const {
    return quick ? if_quick : if_full;
  }
  [[nodiscard]] unsigned rounds() const { return choose(5U, 7U); }
  [[nodiscard]] std::size_t ray_count() const { return choose<std::size_t>(10'000, 40'000); }
  /// Settings of trials on one thread.
  [[nodiscard]] TrialSettings trials() const { return {.rounds = rounds(), .stop = stop}; }
  /// Throws Stopped where that is asked for.
  void check_stop() const {
    if (stop.stop_requested()) throw Stopped();
  }
};

/// A scene and the rays that an experiment sends through it.
struct TrialScene {
  std::string name;
  Scene scene;
  std::vector<Ray> rays;

  [[nodiscard]] double primitives() const { return static_cast<double>(scene.primitive_count()); }
};

/// Primitives of one size in the unit cube, scattered by scatter(), and rays that start anywhere in it.
[[nodiscard]] TrialScene scattered_scene(const ScatterSettings& settings, std::size_t ray_count);

/// A scene by its name or file, and rays of one kind.
[[nodiscard]] TrialScene named_scene(const std::string& source, RayKind kind, std::size_t ray_count);

/// Generated scenes that differ in what is hard about them, each of about that many triangles: terrain, a tree, tessellated spheres of all sizes, long thin
/// triangles, a small dense object in a large hall.
[[nodiscard]] std::vector<TrialScene> varied_scenes(std::size_t triangles, RayKind kind, std::size_t ray_count);

}  // namespace grove
