#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "grove/render/bsdf/bsdf.h"
#include "grove/render/material/gltf_surface.h"
#include "grove/render/surface/surface_point.h"
#include "grove/render/texture/flat_blocks.h"
#include "grove/scene/scene.h"

namespace grove {

/// The materials of a scene with the tables that their scattering functions need. Refers to the scene; any number of threads may use it.
class MaterialTable {
 public:
  /// Integrates a table for each index of refraction that rough glass and coats have.
  explicit MaterialTable(const Scene& scene);

  /// The surface's scattering function as seen by a viewer. `u` in [0, 1) decides between the materials of a mix, and between transmission and
  /// the rest of a glTF material.
  [[nodiscard]] Bsdf bsdf(const SurfacePoint& point, const SurfaceView& view, float u) const;

  /// The shading normal with normal and bump maps, on the outer side.
  [[nodiscard]] Vec3 shading_normal(const SurfacePoint& point) const;

  /// The part of light that is left after a way of `distance` world units inside of a volume with this boundary, by Beer's law (KHR_materials_volume).
  [[nodiscard]] Vec3 transmittance_inside(std::uint32_t material, float distance) const;

  /// Whether light that crosses this boundary is inside of a volume that absorbs.
  [[nodiscard]] bool absorbs_inside(std::uint32_t material) const { return absorption_[material] != Vec3(0.0F); }
  [[nodiscard]] bool any_absorbs_inside() const { return any_absorbs_inside_; }

  /// `grove::opacity` of this material, bit for bit, mostly without a look at its picture: for hits met at random.
  [[nodiscard]] float opacity(std::uint32_t material, const SurfaceCoordinates& place) const;

  /// Whether light may pass surfaces of this material (`opacity` below 1).
  [[nodiscard]] bool can_pass_light(std::uint32_t material) const { return can_pass_light_[material] != 0; }
  [[nodiscard]] bool any_can_pass_light() const { return any_can_pass_light_; }

 private:
  [[nodiscard]] const DielectricAlbedo* table(float ior) const;

  const Scene* scene_;
  std::map<float, std::unique_ptr<const DielectricAlbedo>> tables_;
  std::vector<Vec3> absorption_;  // by material, per world unit
  std::vector<std::uint8_t> can_pass_light_;
  std::vector<std::optional<FlatBlocks>> flat_alpha_;  // by material
  bool any_absorbs_inside_ = false;
  bool any_can_pass_light_ = false;
};

}  // namespace grove
