#include "grove/render/camera_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "grove/base/error.h"
#include "grove/math/transform.h"
#include "grove/render/sampling/warp.h"

namespace grove {

CameraRays::CameraRays(const Camera& camera, std::uint32_t width, std::uint32_t height)
    : camera_to_world_(camera.camera_to_world), lens_radius_(camera.lens_radius), focus_distance_(camera.focus_distance) {
  const std::string name = camera.name.empty() ? "the camera" : "camera '" + camera.name + "'";
  // Rays need its directions to be invertible and its place to be finite; the inverse of a huge translation may overflow.
  const bool is_placed = Ray::is_within(Vec3(camera.camera_to_world[3]), std::numeric_limits<float>::max());
  if (!is_placed || !Transform(Mat4(Mat3(camera.camera_to_world))).is_invertible()) {
    throw InputError(name + " has a transform that cannot be inverted");
  }
  if (!(camera.field_of_view > 0.0F && camera.field_of_view < kPi)) {
    throw InputError(name + " has a field of view that is not between 0 and 180 degrees");
  }
  world_to_camera_ = Mat4(glm::inverse(glm::dmat4(camera_to_world_)));
  const auto w = static_cast<float>(width);
  const auto h = static_cast<float>(height);
  const bool is_horizontal = camera.axis == FieldOfViewAxis::horizontal || (camera.axis == FieldOfViewAxis::smaller && width < height);
  const float half = std::tan(0.5F * camera.field_of_view);
  const Vec2 extent = is_horizontal ? Vec2(half, half * h / w) : Vec2(half * w / h, half);
  corner_ = Vec2(-extent.x, extent.y);
  scale_ = Vec2(2.0F * extent.x / w, -2.0F * extent.y / h);
  if (!(lens_radius_ > 0.0F) || !(focus_distance_ > 0.0F)) lens_radius_ = 0.0F;
}

Ray CameraRays::ray(const Vec2& film, const Vec2& lens) const {
  const Vec2 place = corner_ + scale_ * film;
  Vec3 origin(0.0F);
  Vec3 direction(place.x, place.y, -1.0F);
  if (lens_radius_ > 0.0F) {
    // Rays through all of the lens meet in the plane of focus.
    const Vec2 on_lens = lens_radius_ * sample_disk(lens);
    origin = Vec3(on_lens, 0.0F);
    direction = focus_distance_ * direction - origin;
  }
  Ray ray;
  ray.origin = Vec3(camera_to_world_ * Vec4(origin, 1.0F));
  ray.direction = glm::normalize(Mat3(camera_to_world_) * direction);
  return ray;
}

FilmPlace CameraRays::place(const Vec4& in_world) const {
  const Vec4 in_camera = world_to_camera_ * in_world;
  const float depth = -in_camera.z;
  return {(Vec2(in_camera) / depth - corner_) / scale_, depth};
}

Camera frame_bounds(const Box& bounds, float aspect, float field_of_view) {
  constexpr float kMargin = 1.1F;
  const Vec3 from = glm::normalize(Vec3(0.55F, 0.42F, 1.0F));
  const Vec3 up(0.0F, 1.0F, 0.0F);
  const Vec3 right = glm::normalize(glm::cross(up, from));
  const Vec3 true_up = glm::cross(from, right);
  const Vec3 half = 0.5F * bounds.extent();
  const float tan_y = std::tan(0.5F * field_of_view);
  const float tan_x = tan_y * aspect;
  // Far enough that each corner of the box is within the frustum.
  float distance = 0.0F;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p = half * Vec3(corner & 1 ? 1.0F : -1.0F, corner & 2 ? 1.0F : -1.0F, corner & 4 ? 1.0F : -1.0F);
    const float needed = std::max(std::fabs(glm::dot(p, right)) / tan_x, std::fabs(glm::dot(p, true_up)) / tan_y);
    distance = std::max(distance, kMargin * needed + glm::dot(p, from));
  }
  // A scene that is one point has no size to go by.
  if (!(distance > 0.0F)) distance = std::max(1.0F, glm::length(bounds.centre()) * 1e-3F);
  return look_at(bounds.centre() + distance * from, bounds.centre(), up, field_of_view);
}

}  // namespace grove
