#include "grove/render/integrator/shading_point.h"

namespace grove {

ShadingPoint::ShadingPoint(const PreparedScene& world, const SurfacePoint& point, const Vec3& to_viewer, float u) {
  is_outside = glm::dot(to_viewer, point.geometric_normal) >= 0.0F;
  facing_geometric = is_outside ? point.geometric_normal : -point.geometric_normal;
  Vec3 normal = world.materials.shading_normal(point);
  if (!is_outside) normal = -normal;
  // Near silhouettes interpolated and mapped normals may look away from the viewer: bent back until they are seen at this cosine.
  constexpr float kMinCosine = 0.01F;
  const float cosine = glm::dot(normal, to_viewer);
  if (cosine < kMinCosine) {
    const Vec3 sideways = normal - cosine * to_viewer;
    const float length = glm::length(sideways);
    normal = length > 1e-6F ? glm::normalize(sideways / length + kMinCosine * to_viewer) : facing_geometric;
  }
  frame = Frame(normal);
  wo = frame.to_local(to_viewer);
  wo.z = std::max(wo.z, 1e-6F);
  bsdf = world.materials.bsdf(point, {frame, wo, is_outside}, u);
}

}  // namespace grove
