#pragma once

#include "grove/render/bsdf/bsdf.h"
#include "grove/render/surface/frame.h"
#include "grove/render/surface/surface_point.h"
#include "grove/scene/scene.h"

namespace grove {

/// How a viewer meets a surface.
struct SurfaceView {
  Frame frame;  ///< of the shading normal, turned to the viewer's side
  Vec3 wo{0.0F, 0.0F, 1.0F};
  bool is_outside = true;  ///< on the side of the geometric normal
};

/// The scattering function of a glTF material (MaterialKind::metallic_roughness). `u` in [0, 1) decides between transmission and the rest.
/// `table` is that of the material's index; needed where it is rough and transmits into a volume.
[[nodiscard]] Bsdf gltf_bsdf(const Scene& scene, const Material& material, const SurfacePoint& point, const SurfaceView& view,
                             const DielectricAlbedo* table, float u);

/// The part of what a glTF material emits at `point` towards `direction` (unit length) that its clear coat lets out: what the coat does not reflect of light from there, which is
/// KHR_materials_clearcoat's 1 - clearcoat * Fresnel where the coat is smooth. 1 without a coat, and on the inner side of a volume, which no coat lines.
[[nodiscard]] float coat_transmittance(const Scene& scene, const Material& material, const SurfacePoint& point, const Vec3& direction);

/// Where indices of refraction stop to mean anything; 1 for those that are none.
[[nodiscard]] float usable_ior(float ior);

}  // namespace grove
