#include "grove/scene/formats/mesh_scene.h"

#include <cmath>
#include <memory>
#include <utility>

namespace grove {
namespace {

// As TriangleMesh has it.
constexpr float kMaxCoordinate = 1e38F;

bool is_hittable(const Vec3& p) {
  // Written so that NaN fails.
  return std::fabs(p.x) <= kMaxCoordinate && std::fabs(p.y) <= kMaxCoordinate && std::fabs(p.z) <= kMaxCoordinate;
}

}  // namespace

std::size_t drop_unhittable(const std::vector<Vec3>& vertices, std::vector<Triangle>& triangles) {
  return std::erase_if(triangles, [&](const Triangle& t) {
    return !is_hittable(vertices[t.x]) || !is_hittable(vertices[t.y]) || !is_hittable(vertices[t.z]);
  });
}

std::string unhittable_warning(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " triangle was" : " triangles were") +
         " left out: a coordinate is not a finite number, or beyond 1e38";
}

void mend_normals(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles, std::vector<Vec3>& normals) {
  std::vector<bool> is_bad(normals.size(), false);
  bool any_bad = false;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const double length = glm::length(glm::dvec3(normals[i]));
    if (length > 0.0 && std::isfinite(length)) {
      normals[i] = Vec3(glm::dvec3(normals[i]) / length);
    } else {
      normals[i] = Vec3(0.0F);
      is_bad[i] = any_bad = true;
    }
  }
  if (!any_bad) return;

  std::vector<glm::dvec3> sums(normals.size(), glm::dvec3(0.0));
  for (const Triangle& t : triangles) {
    if (!is_bad[t.x] && !is_bad[t.y] && !is_bad[t.z]) continue;
    const glm::dvec3 a(vertices[t.x]);
    const glm::dvec3 area = glm::cross(glm::dvec3(vertices[t.y]) - a, glm::dvec3(vertices[t.z]) - a);
    for (const std::uint32_t v : {t.x, t.y, t.z}) sums[v] += area;
  }
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (!is_bad[i]) continue;
    const double length = glm::length(sums[i]);
    normals[i] = length > 0.0 && std::isfinite(length) ? Vec3(sums[i] / length) : Vec3(0.0F, 0.0F, 1.0F);
  }
}

Material default_material() {
  Material material;
  material.name = "default";
  material.base_colour.value = Vec3(0.7F);
  material.roughness.value = 0.6F;
  return material;
}

Scene single_mesh_scene(TriangleMesh mesh, Part part, Material material) {
  Scene scene;
  scene.materials.push_back(std::move(material));
  Object object;
  object.name = part.name;
  object.geometry = std::make_shared<TriangleMesh>(std::move(mesh));
  object.parts.push_back(std::move(part));
  scene.objects.push_back(std::move(object));
  scene.instances.push_back({.name = scene.objects[0].name, .object = 0, .object_to_world = Transform()});
  return scene;
}

}  // namespace grove
