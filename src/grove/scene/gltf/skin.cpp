#include "grove/scene/gltf/skin.h"

#include <string>

#include "grove/scene/gltf/accessors.h"

namespace grove {

GltfSkin read_skin(GltfDocument& document, const GltfNodes& nodes, std::uint32_t id) {
  const JsonCursor skin = document.array("skins").element(id);
  const JsonCursor joints = skin["joints"];
  const JsonCursor inverse_bind = skin["inverseBindMatrices"];
  std::vector<Mat4> bind;
  if (inverse_bind.exists()) bind = GltfAccessors(document).mat4s(inverse_bind);
  if (inverse_bind.exists() && bind.size() < joints.size()) {
    inverse_bind.fail("has " + std::to_string(bind.size()) + " matrices for " + std::to_string(joints.size()) + " joints");
  }
  document.charge(joints.size() * sizeof(Mat4), joints);
  GltfSkin result;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const std::uint32_t node = joints.element(i).required_index(nodes.to_world.size(), "nodes");
    const Mat4 joint = bind.empty() ? nodes.to_world[node] : nodes.to_world[node] * bind[i];
    if (!is_finite(joint)) joints.element(i).fail("is a joint whose transform is not finite");
    result.joint_to_world.push_back(joint);
  }
  return result;
}

Mat3 normal_matrix(const Mat4& matrix) {
  const Vec3 x(matrix[0]);
  const Vec3 y(matrix[1]);
  const Vec3 z(matrix[2]);
  const Mat3 cofactors(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
  // The inverse transpose is the cofactors over the determinant.
  return glm::dot(x, cofactors[0]) < 0.0F ? -cofactors : cofactors;
}

}  // namespace grove
