#pragma once

#include <cstdint>
#include <vector>

#include "grove/math/vector.h"
#include "grove/scene/gltf/document.h"
#include "grove/scene/gltf/nodes.h"

namespace grove {

/// A skin's joints at rest: for each joint, its node's world transform after the inverse bind matrix.
struct GltfSkin {
  std::vector<Mat4> joint_to_world;
};

/// Reads skin number `id`. Throws InputError when a joint has no finite transform or the inverse bind matrices are too few.
[[nodiscard]] GltfSkin read_skin(GltfDocument& document, const GltfNodes& nodes, std::uint32_t id);

/// Inverse transpose of a linear map but for a factor: its cofactors, which exist for singular maps too. The sign keeps normals on their
/// side under reflections: n is taken to the normal of the transformed surface whose front is the transformed front.
[[nodiscard]] Mat3 normal_matrix(const Mat4& matrix);

}  // namespace grove
