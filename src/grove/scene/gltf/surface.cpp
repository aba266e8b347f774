#include "grove/scene/gltf/surface.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "grove/scene/animation/affine.h"
#include "grove/scene/gltf/skin_sets.h"
#include "grove/scene/gltf/vertex_source.h"

namespace grove {
namespace {

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Targets of weight 0 take no part and are read only where all are to be kept.
std::vector<MorphTarget> read_targets(const VertexSource& source, const JsonCursor& primitive, const GltfShape& shape) {
  const JsonCursor targets = primitive["targets"];
  const std::size_t weighted = std::min(targets.size(), shape.morph_weights.size());
  std::vector<MorphTarget> result(shape.keeps_undeformed ? targets.size() : weighted);
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (!shape.keeps_undeformed && shape.morph_weights[i] == 0.0F) continue;
    const auto read = [&](const char* name, std::vector<Vec3>& moves) {
      const JsonCursor deltas = targets.element(i)[name];
      if (deltas.exists()) moves = source.other_vec3s(deltas);
    };
    read("POSITION", result[i].positions);
    read("NORMAL", result[i].normals);
    read("TANGENT", result[i].tangents);
  }
  return result;
}

void warn_about_gaps(GltfDocument& document, Scene& scene, const VertexSource& source, const JsonCursor& primitive,
                     const GltfSurface& surface) {
  if (source.spare_index_count() > 0 && document.is_first("spare indices")) {
    scene.warn("indices at the end of a list that make no whole triangle are left out, such as in " + primitive.path());
  }
  if (!std::all_of(surface.vertices.begin(), surface.vertices.end(), is_finite) && document.is_first("infinite vertices")) {
    scene.warn("triangles with coordinates that are not finite cannot be hit, such as in " + primitive.path());
  }
}

}  // namespace

GltfSurface read_surface(GltfDocument& document, Scene& scene, const JsonCursor& primitive, const GltfShape& shape) {
  GltfSurface surface;
  if (!VertexSource::has_triangles(primitive)) {
    if (document.is_first("points")) scene.warn("points and lines are left out, such as " + primitive.path());
    return surface;
  }
  const VertexSource source(document, primitive);
  if (source.triangles().empty()) {
    warn_about_gaps(document, scene, source, primitive, surface);
    return surface;
  }
  surface.uvs = source.vec2s("TEXCOORD_0");
  surface.colours = source.colours("COLOR_0");
  DeformableSurface plain;
  plain.triangles = source.triangles();
  plain.vertices = source.vec3s("POSITION");
  if (plain.vertices.empty()) primitive["attributes"]["POSITION"].fail("is missing");
  plain.normals = source.vec3s("NORMAL");
  // Without normals the specification has tangents ignored: they would belong to normals that are not there.
  if (!plain.normals.empty()) plain.tangents = source.vec4s("TANGENT");
  plain.targets = read_targets(source, primitive, shape);
  if (!shape.joints.empty()) plain.skin = read_skin_sets(document, source, primitive, shape.joints.size(), scene);
  if (shape.keeps_undeformed) {
    document.charge(plain.vertices.size() * (2 * sizeof(Vec3) + sizeof(Vec4)), primitive);
    surface.undeformed = plain;
  }
  deform(plain, shape.morph_weights, shape.joints, {plain.vertices, plain.normals, plain.tangents});
  surface.triangles = std::move(plain.triangles);
  surface.vertices = std::move(plain.vertices);
  surface.normals = std::move(plain.normals);
  surface.tangents = std::move(plain.tangents);
  warn_about_gaps(document, scene, source, primitive, surface);
  return surface;
}

void transform_surface(GltfSurface& surface, const Mat4& matrix) {
  const Mat3 normals = normal_matrix(matrix);
  const bool reflects = glm::determinant(glm::dmat3(matrix)) < 0.0;
  for (Vec3& vertex : surface.vertices) vertex = Vec3(matrix * Vec4(vertex, 1.0F));
  for (Vec3& normal : surface.normals) normal = safe_normalise(normals * normal);
  for (Vec4& tangent : surface.tangents) {
    tangent = Vec4(safe_normalise(Vec3(matrix * Vec4(Vec3(tangent), 0.0F))), reflects ? -tangent.w : tangent.w);
  }
  if (!reflects) return;
  for (Triangle& triangle : surface.triangles) std::swap(triangle.y, triangle.z);
}

}  // namespace grove
