#pragma once

#include <cstdint>
#include <vector>

#include "grove/math/vector.h"
#include "grove/scene/animation/node_tree.h"
#include "grove/scene/gltf/document.h"
#include "grove/scene/scene.h"

namespace grove {

/// A node of the scene that is shown, in the order of a depth-first walk.
struct GltfNode {
  std::uint32_t id = 0;
  Mat4 to_world{1.0F};
};

/// The node hierarchy with world transforms at rest.
struct GltfNodes {
  NodeTree tree;
  /// The nodes of the scene that is shown, but for those whose transform is not finite.
  std::vector<GltfNode> shown;
  /// World transform of each node of the file, shown or not; not finite for nodes inside a cycle that nothing reaches.
  std::vector<Mat4> to_world;
};

/// Walks the default scene (the first where none is named; all root nodes where there is no scene), without recursion. Throws InputError
/// when a node can be reached twice: a cycle, or a node with two parents. Nodes whose transform is not finite are left out with a warning.
[[nodiscard]] GltfNodes read_nodes(GltfDocument& document, Scene& scene);

}  // namespace grove
