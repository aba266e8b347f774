#include "grove/scene/animation/placement.h"

#include <cmath>

namespace grove {
namespace {

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Zero when the node is scaled to nothing.
Vec3 forward(const Mat4& to_world) {
  const Vec3 axis = -Vec3(to_world[2]);
  const float length = glm::length(axis);
  return length > 0.0F && std::isfinite(length) ? axis / length : Vec3(0.0F);
}

}  // namespace

bool place_camera(const Mat4& node_to_world, Camera& camera) {
  Mat4 matrix = node_to_world;
  if (!is_finite(Vec3(matrix[3]))) return false;
  for (int axis = 0; axis < 3; ++axis) {
    const float length = glm::length(Vec3(matrix[axis]));
    if (!(length > 0.0F) || !std::isfinite(length)) return false;
    matrix[axis] /= length;
  }
  if (!(std::abs(glm::determinant(Mat3(matrix))) > 1e-6F)) return false;
  camera.camera_to_world = matrix;
  return true;
}

bool place_light(const Mat4& node_to_world, PunctualLight& light) {
  const Vec3 direction = forward(node_to_world);
  const Vec3 position(node_to_world[3]);
  if (!is_finite(position) || (light.kind != PunctualLightKind::point && direction == Vec3(0.0F))) return false;
  light.position = position;
  light.direction = direction;
  return true;
}

}  // namespace grove
