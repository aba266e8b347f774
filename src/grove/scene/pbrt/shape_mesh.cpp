#include "grove/scene/pbrt/shape_mesh.h"

#include <cmath>
#include <utility>

#include <glm/mat3x3.hpp>

namespace grove::pbrt {
namespace {

bool is_unit(const Vec3& n) {
  const float length_squared = glm::dot(n, n);
  return length_squared > 0.5F && length_squared < 2.0F;
}

// The sides of a large triangle may overflow when multiplied in float.
glm::dvec3 winding_normal(const ShapeMesh& mesh, const Triangle& t) {
  const glm::dvec3 a(mesh.vertices[t.x]);
  return glm::cross(glm::dvec3(mesh.vertices[t.y]) - a, glm::dvec3(mesh.vertices[t.z]) - a);
}

void transform_normals(ShapeMesh& mesh, const Matrix& to_world, bool reverse_orientation) {
  const glm::dmat3 to_normal = glm::transpose(glm::inverse(glm::dmat3(to_world))) * (reverse_orientation ? -1.0 : 1.0);
  for (Vec3& normal : mesh.normals) normal = Vec3(glm::normalize(to_normal * glm::dvec3(normal)));
}

// Vertex normals of zero length or with NaN come from the triangle instead.
void mend_normals(ShapeMesh& mesh, const Triangle& t) {
  for (int corner = 0; corner < 3; ++corner) {
    Vec3& normal = mesh.normals[t[corner]];
    if (is_unit(normal)) continue;
    const Vec3 flat(glm::normalize(winding_normal(mesh, t)));
    normal = is_unit(flat) ? flat : Vec3(0.0F, 0.0F, 1.0F);
  }
}

}  // namespace

void place_mesh(ShapeMesh& mesh, const Matrix& to_world, bool reverse_orientation) {
  for (Vec3& vertex : mesh.vertices) vertex = transform_point(to_world, vertex);
  for (Vec4& tangent : mesh.tangents) {
    const Vec3 direction = transform_vector(to_world, Vec3(tangent));
    const float length = glm::length(direction);
    tangent = length > 0.0F && std::isfinite(length) ? Vec4(direction / length, tangent.w) : Vec4(1.0F, 0.0F, 0.0F, 1.0F);
  }
  transform_normals(mesh, to_world, reverse_orientation);

  const bool rewind = reverse_orientation != is_mirrored(to_world);
  for (Triangle& t : mesh.triangles) {
    if (rewind) std::swap(t.y, t.z);
    if (mesh.normals.empty()) continue;
    mend_normals(mesh, t);
    const Vec3 shading = mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z];
    if (glm::dot(winding_normal(mesh, t), glm::dvec3(shading)) < 0.0) std::swap(t.y, t.z);
  }
}

void add_default_uvs(ShapeMesh& mesh) {
  if (!mesh.uvs.empty()) return;
  ShapeMesh split;
  split.uvs.reserve(3 * mesh.triangles.size());
  split.vertices.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(split.vertices.size());
    for (int corner = 0; corner < 3; ++corner) {
      split.vertices.push_back(mesh.vertices[t[corner]]);
      if (!mesh.normals.empty()) split.normals.push_back(mesh.normals[t[corner]]);
      if (!mesh.tangents.empty()) split.tangents.push_back(mesh.tangents[t[corner]]);
    }
    split.uvs.insert(split.uvs.end(), {Vec2(0.0F, 0.0F), Vec2(1.0F, 0.0F), Vec2(1.0F, 1.0F)});
    split.triangles.emplace_back(first, first + 1, first + 2);
  }
  mesh = std::move(split);
}

}  // namespace grove::pbrt
