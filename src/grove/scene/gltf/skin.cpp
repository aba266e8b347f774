#include "grove/scene/gltf/skin.h"

#include <string>

#include "grove/scene/animation/affine.h"
#include "grove/scene/gltf/accessors.h"

namespace grove {

Skin read_skin(GltfDocument& document, const std::vector<Mat4>& to_world, std::uint32_t id, Scene& scene) {
  const JsonCursor source = document.array("skins").element(id);
  const JsonCursor joints = source["joints"];
  const JsonCursor inverse_bind = source["inverseBindMatrices"];
  Skin skin;
  if (inverse_bind.exists()) skin.inverse_bind = GltfAccessors(document).mat4s(inverse_bind);
  if (inverse_bind.exists() && skin.inverse_bind.size() < joints.size()) {
    inverse_bind.fail("has " + std::to_string(skin.inverse_bind.size()) + " matrices for " + std::to_string(joints.size()) + " joints");
  }
  document.charge(joints.size() * sizeof(Mat4), joints);
  skin.inverse_bind.resize(joints.size(), Mat4(1.0F));
  skin.joints.reserve(joints.size());
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const std::uint32_t node = joints.element(i).required_index(to_world.size(), "nodes");
    skin.joints.push_back(node);
    if (!is_finite(to_world[node] * skin.inverse_bind[i]) && document.is_first("infinite joint")) {
      scene.warn("joints whose transform is not finite leave their vertices in the bind pose, such as " + joints.element(i).path());
    }
  }
  return skin;
}

}  // namespace grove
