#pragma once

#include <optional>
#include <string>

#include "grove/scene/animation/scene_animation.h"
#include "grove/scene/gltf/document.h"
#include "grove/scene/gltf/nodes.h"
#include "grove/scene/scene.h"

namespace grove {

/// Reads the animation of the name `choice`, else of that number, else, when it is empty, the first; nothing where the file has none and none is asked for.
/// Keyframes whose times or values are not finite are left out, unsorted ones sorted, of several at one time the last is taken; channels without
/// keyframes, or to nodes that are not there or that have a matrix, are left out: each with a warning that names the channel. Only the channels are filled
/// in. Throws UsageError for an animation that is not there.
[[nodiscard]] std::optional<SceneAnimation> read_animation(GltfDocument& document, const GltfNodes& nodes, const std::string& choice,
                                                           Scene& scene);

}  // namespace grove
