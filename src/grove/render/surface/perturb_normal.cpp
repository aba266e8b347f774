#include "grove/render/surface/perturb_normal.h"

#include <algorithm>
#include <cmath>

#include "grove/render/texture/evaluate_texture.h"

namespace grove {
namespace {

struct Tangents {
  Vec3 tangent{0.0F};
  Vec3 bitangent{0.0F};
};

// The texture's right and up on the surface, in the plane of the normal; false where the mesh does not tell.
bool texture_tangents(const Texture& texture, const SurfacePoint& point, Tangents& result) {
  const Vec3& n = point.shading_normal;
  const Vec3& dp_du = texture.uv_set == 1 ? point.second_dp_du : point.dp_du;
  const Vec3& dp_dv = texture.uv_set == 1 ? point.second_dp_dv : point.dp_dv;
  Vec3 along = Vec3(point.tangent);
  float handedness = point.tangent.w;
  if (along == Vec3(0.0F)) {
    // From texture coordinates as the image sees them. v runs down the image and a normal map's y runs up, so that the frame is
    // right-handed where (dp/du, dp/dv, n) is left-handed.
    const Mat3& to_image = texture.uv_transform;
    const float determinant = to_image[0][0] * to_image[1][1] - to_image[1][0] * to_image[0][1];
    if (determinant == 0.0F) return false;
    // Where u of the image grows while v stays: the first column of the inverse.
    along = (to_image[1][1] * dp_du - to_image[0][1] * dp_dv) / determinant;
    handedness = glm::dot(glm::cross(dp_du, dp_dv), n) * determinant < 0.0F ? 1.0F : -1.0F;
  }
  along -= n * glm::dot(n, along);
  const float length = glm::length(along);
  if (!(length > 0.0F) || !std::isfinite(length)) return false;
  result.tangent = along / length;
  result.bitangent = glm::cross(n, result.tangent) * handedness;
  return true;
}

Vec3 normal_mapped(const Scene& scene, std::uint32_t texture, float scale, const SurfacePoint& point) {
  Tangents frame;
  if (!texture_tangents(scene.textures[texture], point, frame)) return point.shading_normal;
  const Vec3 value = 2.0F * Vec3(evaluate_texture(scene, texture, point.coordinates())) - Vec3(1.0F);
  return scale * (value.x * frame.tangent + value.y * frame.bitangent) + value.z * point.shading_normal;
}

// Blinn 1978, "Simulation of Wrinkled Surfaces": the normal of the surface moved along its normal by the height.
Vec3 bumped(const Scene& scene, const Material& material, const SurfacePoint& point, const Vec3& normal) {
  constexpr float kStep = 5e-4F;  // of texture space: half a texel at 1024
  const float here = evaluate(scene, material.bump, point.uv);
  const float right = evaluate(scene, material.bump, point.uv + Vec2(kStep, 0.0F));
  const float ahead = evaluate(scene, material.bump, point.uv + Vec2(0.0F, kStep));
  const Vec3 du = point.dp_du + normal * ((right - here) / kStep);
  const Vec3 dv = point.dp_dv + normal * ((ahead - here) / kStep);
  const Vec3 moved = glm::cross(du, dv);
  return glm::dot(glm::cross(point.dp_du, point.dp_dv), normal) < 0.0F ? -moved : moved;
}

// Of unit length and on the outer side, or the vertex normals'.
Vec3 usable(const Vec3& normal, const SurfacePoint& point) {
  const float length = glm::length(normal);
  if (!(length > 1e-20F) || !std::isfinite(length)) return point.shading_normal;
  return glm::dot(normal, point.geometric_normal) < 0.0F ? point.shading_normal : normal / length;
}

}  // namespace

Vec3 perturbed_normal(const Scene& scene, const Material& material, const SurfacePoint& point) {
  Vec3 normal = point.shading_normal;
  if (material.normal_texture != kNoTexture) normal = normal_mapped(scene, material.normal_texture, material.normal_scale, point);
  if (material.bump.texture != kNoTexture && material.bump.value != 0.0F) normal = bumped(scene, material, point, glm::normalize(normal));
  return usable(normal, point);
}

Vec3 coat_normal(const Scene& scene, const Material& material, const SurfacePoint& point) {
  if (material.coat_normal_texture == kNoTexture) return point.shading_normal;
  return usable(normal_mapped(scene, material.coat_normal_texture, material.coat_normal_scale, point), point);
}

}  // namespace grove
