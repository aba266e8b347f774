#pragma once

#include "grove/scene/gltf/document.h"
#include "grove/scene/gltf/motion.h"
#include "grove/scene/gltf/nodes.h"
#include "grove/scene/scene.h"

namespace grove {

/// Adds the punctual lights (KHR_lights_punctual) of the nodes that are shown. Candela and lux are kept as the numbers that they are.
/// Those whose nodes move follow them.
void read_lights(GltfDocument& document, const GltfNodes& nodes, Scene& scene, GltfMotion& motion);

/// Adds the perspective cameras of the nodes that are shown; a camera without a name takes its node's. Those whose nodes move
/// follow them.
void read_cameras(GltfDocument& document, const GltfNodes& nodes, Scene& scene, GltfMotion& motion);

}  // namespace grove
