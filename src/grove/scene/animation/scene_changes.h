#pragma once

#include <cstdint>
#include <vector>

namespace grove {

/// What a scene at one time has otherwise than at the time before.
struct SceneChanges {
  std::vector<std::uint32_t> instances;  ///< those that stand elsewhere
  std::vector<std::uint32_t> objects;    ///< those whose vertices moved, each once
  bool cameras = false;
  bool lights = false;

  /// Whether what rays can hit has changed.
  [[nodiscard]] bool has_geometry() const { return !instances.empty() || !objects.empty(); }
};

}  // namespace grove
