#include "grove/scene/camera.h"

#include <cmath>

namespace grove {

Camera look_at(const Vec3& eye, const Vec3& target, const Vec3& up, float field_of_view) {
  // In double, where the squares of tiny and of huge lengths neither vanish nor overflow.
  const glm::dvec3 view = glm::dvec3(target) - glm::dvec3(eye);
  const Vec3 forward(glm::normalize(view));
  const Vec3 right(glm::normalize(glm::cross(glm::dvec3(forward), glm::dvec3(up))));
  const Vec3 true_up = glm::cross(right, forward);
  Camera camera;
  camera.camera_to_world = Mat4(Vec4(right, 0.0F), Vec4(true_up, 0.0F), Vec4(-forward, 0.0F), Vec4(eye, 1.0F));
  camera.field_of_view = field_of_view;
  camera.focus_distance = static_cast<float>(glm::length(view));
  return camera;
}

}  // namespace grove
