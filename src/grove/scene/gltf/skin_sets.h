#pragma once

#include <vector>

#include "grove/scene/animation/deform.h"
#include "grove/scene/gltf/document.h"
#include "grove/scene/gltf/vertex_source.h"
#include "grove/scene/scene.h"

namespace grove {

/// Which of a skin's `joint_count` joints hold the vertices of a primitive: all sets JOINTS_n and WEIGHTS_n. Weights that do not sum to 1 are scaled; joints
/// that are not there, and weights that are negative or not finite, are left out; a vertex that nothing holds then is held by the first joint. Warns of
/// each, naming the primitive. None when the skin has no joints. Throws InputError where weights are missing.
[[nodiscard]] std::vector<SkinSet> read_skin_sets(GltfDocument& document, const VertexSource& source, const JsonCursor& primitive,
                                                  std::size_t joint_count, Scene& scene);

}  // namespace grove
