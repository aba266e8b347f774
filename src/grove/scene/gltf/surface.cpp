#include "grove/scene/gltf/surface.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "grove/scene/gltf/vertex_source.h"

namespace grove {
namespace {

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Zero when there is no direction to keep. Scaled first, so that squares neither overflow nor vanish.
Vec3 safe_normalise(const Vec3& v) {
  const float largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!is_finite(v) || !(largest > 0.0F)) return Vec3(0.0F);
  return glm::normalize(v / largest);
}

// Adds each target's deltas times its weight (glTF 2.0 section 3.7.2.2).
void blend_morph_targets(const VertexSource& source, const JsonCursor& primitive, std::span<const double> weights, GltfSurface& surface) {
  const JsonCursor targets = primitive["targets"];
  for (std::size_t i = 0; i < std::min(targets.size(), weights.size()); ++i) {
    const float weight = to_float(weights[i]);
    if (weight == 0.0F) continue;
    const auto add = [&](const char* name, auto& values) {
      const JsonCursor deltas = targets.element(i)[name];
      if (values.empty() || !deltas.exists()) return;
      const std::vector<Vec3> moves = source.other_vec3s(deltas);
      for (std::size_t v = 0; v < values.size(); ++v) {
        for (int axis = 0; axis < 3; ++axis) values[v][axis] += weight * moves[v][axis];
      }
    };
    add("POSITION", surface.vertices);
    add("NORMAL", surface.normals);
    add("TANGENT", surface.tangents);
  }
}

/// Moves surface vertices by blended joint matrices (glTF 2.0 section 3.7.3.3): any number of sets of four joints a vertex.
void bend_by_skin(const VertexSource& source, const JsonCursor& primitive, const GltfSkin& skin, GltfSurface& surface) {
  std::vector<Mat4> blend(surface.vertices.size(), Mat4(0.0F));
  std::vector<float> sum(surface.vertices.size(), 0.0F);
  const JsonCursor attributes = primitive["attributes"];
  for (unsigned set = 0; attributes["JOINTS_" + std::to_string(set)].exists(); ++set) {
    const std::string joints_name = "JOINTS_" + std::to_string(set);
    const std::string weights_name = "WEIGHTS_" + std::to_string(set);
    const std::vector<glm::u32vec4> joints = source.integer_vec4s(joints_name);
    const std::vector<Vec4> weights = source.vec4s(weights_name);
    if (weights.size() != joints.size()) attributes[weights_name].fail("is missing beside " + joints_name);
    for (std::size_t v = 0; v < joints.size(); ++v) {
      for (int k = 0; k < 4; ++k) {
        const float weight = weights[v][k];
        if (!(weight > 0.0F)) continue;
        if (joints[v][k] >= skin.joint_to_world.size()) {
          attributes[joints_name].fail("names joint " + std::to_string(joints[v][k]) + " of " + std::to_string(skin.joint_to_world.size()));
        }
        blend[v] += weight * skin.joint_to_world[joints[v][k]];
        sum[v] += weight;
      }
    }
  }
  for (std::size_t v = 0; v < blend.size(); ++v) {
    // A vertex that no joint holds stays with the first, as if bound to it.
    if (!(sum[v] > 0.0F) && skin.joint_to_world.empty()) continue;
    const Mat4 to_world = sum[v] > 0.0F ? blend[v] * (1.0F / sum[v]) : skin.joint_to_world[0];
    surface.vertices[v] = Vec3(to_world * Vec4(surface.vertices[v], 1.0F));
    if (!surface.normals.empty()) surface.normals[v] = normal_matrix(to_world) * surface.normals[v];
    if (!surface.tangents.empty()) {
      surface.tangents[v] = Vec4(Vec3(to_world * Vec4(Vec3(surface.tangents[v]), 0.0F)), surface.tangents[v].w);
    }
  }
}

// Makes normals and tangents unit length; a normal that has no direction takes that of a triangle beside it.
void mend_directions(GltfSurface& surface) {
  for (Vec3& normal : surface.normals) normal = safe_normalise(normal);
  for (Vec4& tangent : surface.tangents) tangent = Vec4(safe_normalise(Vec3(tangent)), tangent.w < 0.0F ? -1.0F : 1.0F);
  if (surface.normals.empty()) return;
  for (const Triangle& triangle : surface.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      Vec3& normal = surface.normals[triangle[corner]];
      if (normal != Vec3(0.0F)) continue;
      const Vec3& a = surface.vertices[triangle.x];
      normal = safe_normalise(glm::cross(surface.vertices[triangle.y] - a, surface.vertices[triangle.z] - a));
    }
  }
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

GltfSurface read_surface(GltfDocument& document, Scene& scene, const JsonCursor& primitive, std::span<const double> morph_weights,
                         const GltfSkin* skin) {
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
  surface.triangles = source.triangles();
  surface.vertices = source.vec3s("POSITION");
  if (surface.vertices.empty()) primitive["attributes"]["POSITION"].fail("is missing");
  surface.normals = source.vec3s("NORMAL");
  surface.uvs = source.vec2s("TEXCOORD_0");
  if (std::ranges::any_of(scene.textures, [](const Texture& texture) { return texture.uv_set == 1; })) {
    surface.second_uvs = source.vec2s("TEXCOORD_1");
  }
  surface.colours = source.colours("COLOR_0");
  // Without normals the specification has tangents ignored: they would belong to normals that are not there.
  if (!surface.normals.empty()) surface.tangents = source.vec4s("TANGENT");
  blend_morph_targets(source, primitive, morph_weights, surface);
  if (skin != nullptr) bend_by_skin(source, primitive, *skin, surface);
  mend_directions(surface);
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
