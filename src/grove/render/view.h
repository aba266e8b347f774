#pragma once

#include <cstdint>

#include "grove/scene/camera.h"
#include "grove/scene/scene.h"

namespace grove {

struct RenderSettings;

/// What a picture shows: a camera, and how many pixels.
struct View {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  Camera camera;  ///< without a name when it was made for a scene without cameras
};

/// The view that the settings ask for. Throws UsageError for an unknown camera or a picture that is too large.
[[nodiscard]] View choose_view(const Scene& scene, const RenderSettings& settings);

}  // namespace grove
