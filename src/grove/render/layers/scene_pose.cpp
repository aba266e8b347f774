#include "grove/render/layers/scene_pose.h"

#include <algorithm>

namespace grove {
namespace {

std::vector<SphereSet::Sphere> spheres_of(const SphereSet& set) {
  std::vector<SphereSet::Sphere> spheres(set.size());
  for (std::size_t i = 0; i < set.size(); ++i) spheres[i] = set.sphere(i);
  return spheres;
}

bool is_same(const SphereSet::Sphere& a, const SphereSet::Sphere& b) {
  return a.centre == b.centre && a.radius == b.radius;
}

bool is_same_light(const PunctualLight& a, const PunctualLight& b) {
  return a.kind == b.kind && a.position == b.position && a.direction == b.direction && a.intensity == b.intensity &&
         a.inner_angle == b.inner_angle && a.outer_angle == b.outer_angle && a.range == b.range;
}

}  // namespace

ScenePose::ScenePose(const Scene& scene) : lights_(scene.lights) {
  shapes_.reserve(scene.objects.size());
  for (const Object& object : scene.objects) {
    if (const auto* mesh = std::get_if<std::shared_ptr<TriangleMesh>>(&object.geometry)) {
      shapes_.emplace_back(std::vector<Vec3>((*mesh)->vertices().begin(), (*mesh)->vertices().end()));
    } else {
      shapes_.emplace_back(spheres_of(*std::get<std::shared_ptr<SphereSet>>(object.geometry)));
    }
  }
  instances_.reserve(scene.instances.size());
  for (const Instance& instance : scene.instances) instances_.push_back({instance.object, instance.object_to_world});
}

Vec3 ScenePose::position_then(const Scene& now, const Hit& hit, const Vec3& position) const {
  const std::uint32_t number = hit.instance == kInvalidId ? 0 : hit.instance;
  if (number >= instances_.size()) return position;
  const Instance& instance = now.instances[number];
  const PlacedObject& then = instances_[number];
  if (instance.object != then.object) return position;
  const Transform& to_world_now = instance.object_to_world;
  const bool is_placed_the_same = to_world_now.matrix() == then.object_to_world.matrix();
  const auto& geometry = now.objects[instance.object].geometry;

  if (const auto* mesh = std::get_if<std::shared_ptr<TriangleMesh>>(&geometry)) {
    const auto* vertices = std::get_if<std::vector<Vec3>>(&shapes_[then.object]);
    if (vertices == nullptr || vertices->size() != (*mesh)->vertices().size()) return position;
    const Triangle triangle = (*mesh)->triangles()[(*mesh)->first_triangle(hit.geometry) + hit.primitive];
    const Vec3& v0 = (*vertices)[triangle.x];
    const Vec3& v1 = (*vertices)[triangle.y];
    const Vec3& v2 = (*vertices)[triangle.z];
    const auto vertices_now = (*mesh)->vertices();
    // What has not moved is exactly where it was, without rounding.
    if (is_placed_the_same && v0 == vertices_now[triangle.x] && v1 == vertices_now[triangle.y] && v2 == vertices_now[triangle.z]) {
      return position;
    }
    return then.object_to_world.point((1.0F - hit.u - hit.v) * v0 + hit.u * v1 + hit.v * v2);
  }
  const SphereSet& set = *std::get<std::shared_ptr<SphereSet>>(geometry);
  const auto* spheres = std::get_if<std::vector<SphereSet::Sphere>>(&shapes_[then.object]);
  if (spheres == nullptr || spheres->size() != set.size()) return position;
  const std::size_t primitive = set.first_sphere(hit.geometry) + hit.primitive;
  const SphereSet::Sphere& sphere_now = set.sphere(primitive);
  const SphereSet::Sphere& sphere_then = (*spheres)[primitive];
  if (is_placed_the_same && is_same(sphere_now, sphere_then)) return position;
  const Vec3 from_centre = (to_world_now.inverse_point(position) - sphere_now.centre) / sphere_now.radius;
  return then.object_to_world.point(sphere_then.centre + sphere_then.radius * from_centre);
}

bool ScenePose::is_pose_of(const Scene& now) const {
  if (!std::ranges::equal(now.lights, lights_, is_same_light)) return false;
  if (now.objects.size() != shapes_.size() || now.instances.size() != instances_.size()) return false;
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    if (now.instances[i].object != instances_[i].object) return false;
    if (now.instances[i].object_to_world.matrix() != instances_[i].object_to_world.matrix()) return false;
  }
  for (std::size_t i = 0; i < shapes_.size(); ++i) {
    if (const auto* mesh = std::get_if<std::shared_ptr<TriangleMesh>>(&now.objects[i].geometry)) {
      const auto* vertices = std::get_if<std::vector<Vec3>>(&shapes_[i]);
      if (vertices == nullptr || !std::ranges::equal(*vertices, (*mesh)->vertices())) return false;
    } else {
      const auto* spheres = std::get_if<std::vector<SphereSet::Sphere>>(&shapes_[i]);
      const SphereSet& set = *std::get<std::shared_ptr<SphereSet>>(now.objects[i].geometry);
      if (spheres == nullptr || !std::ranges::equal(*spheres, spheres_of(set), is_same)) return false;
    }
  }
  return true;
}

}  // namespace grove
