#pragma once

#include <vector>

#include "grove/math/vector.h"
#include "grove/scene/gltf/document.h"

namespace grove {

/// Whether a node places its mesh by EXT_mesh_gpu_instancing.
[[nodiscard]] bool has_gpu_instances(const JsonCursor& node);

/// The transforms of those instances, in the node's space, from the accessors TRANSLATION, ROTATION and SCALE. Throws InputError when they
/// differ in length.
[[nodiscard]] std::vector<Mat4> read_gpu_instances(GltfDocument& document, const JsonCursor& node);

}  // namespace grove
