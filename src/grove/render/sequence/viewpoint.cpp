#include "grove/render/sequence/viewpoint.h"

#include <cmath>
#include <numbers>

#include "grove/base/error.h"
#include "grove/render/camera_rays.h"

namespace grove {
namespace {

// Rodrigues' formula, in double: a whole turn comes back to where it began.
glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& axis, double turns) {
  const double angle = 2.0 * std::numbers::pi * (turns - std::floor(turns));
  return std::cos(angle) * v + std::sin(angle) * glm::cross(axis, v) + (1.0 - std::cos(angle)) * glm::dot(axis, v) * axis;
}

}  // namespace

Camera camera_at(const Viewpoint& viewpoint, const Box& bounds, float aspect, double turns) {
  const float field_of_view = viewpoint.field_of_view.value_or(kUsualFieldOfView);
  const Vec3 middle = bounds.is_empty() ? Vec3(0.0F) : bounds.centre();
  const glm::dvec3 target(viewpoint.target.value_or(middle));
  glm::dvec3 offset;
  if (viewpoint.eye) {
    offset = glm::dvec3(*viewpoint.eye) - target;
  } else {
    const Camera whole = frame_bounds(bounds.is_empty() ? Box{middle, middle} : bounds, aspect, field_of_view);
    offset = glm::dvec3(Vec3(whole.camera_to_world[3])) - glm::dvec3(middle);
  }
  if (glm::length(glm::dvec3(viewpoint.up)) == 0.0) throw UsageError("--up: 0,0,0 is no direction");
  if (glm::length(offset) == 0.0) throw UsageError("--eye: the eye is where it looks at; move one of them");
  const glm::dvec3 up = glm::normalize(glm::dvec3(viewpoint.up));
  constexpr double kParallel = 1e-6;
  if (glm::length(glm::cross(up, glm::normalize(offset))) < kParallel) {
    throw UsageError("--up: the view is along it; name another direction, such as --up 0,0,1");
  }
  if (turns != 0.0) offset = turned(offset, up, turns);
  return look_at(Vec3(target + offset), Vec3(target), Vec3(up), field_of_view);
}

}  // namespace grove
