#pragma once

#include "grove/scene/gltf/document.h"
#include "grove/scene/gltf/motion.h"
#include "grove/scene/gltf/nodes.h"
#include "grove/scene/scene.h"

namespace grove {

/// Adds the objects and instances of the nodes that are shown. Meshes that one node uses, and all skinned ones, are taken to world space
/// and share one object, a part for each primitive in the order of the nodes; meshes that more nodes use (or EXT_mesh_gpu_instancing
/// places) are objects of their own, after it, with an instance for each node. So are meshes that move; a mesh that is bent or morphed with time is an
/// object for each of its nodes. What moves is told to `motion`. Materials must have been read.
void read_meshes(GltfDocument& document, const GltfNodes& nodes, GltfMotion& motion, Scene& scene);

}  // namespace grove
