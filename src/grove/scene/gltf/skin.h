#pragma once

#include <cstdint>

#include "grove/scene/animation/scene_animation.h"
#include "grove/scene/gltf/document.h"
#include "grove/scene/scene.h"

namespace grove {

/// Reads skin number `id`. Warns of joints that have no finite place at rest, `to_world`. Throws InputError when a joint is no node or the inverse bind
/// matrices are too few.
[[nodiscard]] Skin read_skin(GltfDocument& document, const std::vector<Mat4>& to_world, std::uint32_t id, Scene& scene);

}  // namespace grove
