#include "grove/scene/animation/node_tree.h"

#include <limits>

#include "grove/scene/animation/affine.h"

namespace grove {

glm::dmat4 NodePose::local() const {
  return matrix ? *matrix : compose_transform(translation, rotation, scale);
}

std::vector<Mat4> NodeTree::world_transforms(const std::vector<NodePose>& poses) const {
  std::vector<glm::dmat4> exact(size());
  std::vector<Mat4> rounded(size(), Mat4(std::numeric_limits<float>::quiet_NaN()));
  for (const std::uint32_t node : order) {
    const glm::dmat4 local = poses[node].local();
    exact[node] = parent[node] == kNoParent ? glm::dmat4(1.0) * local : exact[parent[node]] * local;
    rounded[node] = to_single(exact[node]);
  }
  return rounded;
}

std::vector<bool> NodeTree::below(const std::vector<bool>& marked) const {
  std::vector<bool> result(size(), false);
  for (const std::uint32_t node : order) result[node] = marked[node] || (parent[node] != kNoParent && result[parent[node]]);
  return result;
}

}  // namespace grove
