#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "grove/lab/batch.h"
#include "grove/render/scene_accelerator.h"
#include "grove/scene/scene.h"

namespace grove {

/// The kinds of rays that a structure is judged by, from coherent to incoherent.
enum class RayKind : std::uint8_t {
  primary,  ///< through the pixels of the scene's camera, row by row; closest hit
  diffuse,  ///< from what the camera sees, cosine-distributed about the surface's normal; closest hit
  shadow,   ///< the same as segments of a tenth of the scene's diagonal (ambient occlusion); any hit
  random,   ///< origins uniform in the scene's bounds and a little beyond, directions uniform; closest hit
  recorded  ///< what a path-traced picture of the scene shoots, closest and any hits; see recorded_rays.h
};

/// The kinds that `make_rays` makes: all but `recorded`, in the order of the enumeration.
[[nodiscard]] std::span<const RayKind> ray_kinds();
/// All kinds, in the order of the enumeration.
[[nodiscard]] std::span<const RayKind> all_ray_kinds();
[[nodiscard]] std::string_view name_of(RayKind kind);
/// Throws UsageError that lists those allowed.
[[nodiscard]] RayKind parse_ray_kind(std::string_view name, std::span<const RayKind> allowed = ray_kinds());
/// Of a kind that `make_rays` makes.
[[nodiscard]] Query query_of(RayKind kind);

struct WorkloadSettings {
  std::size_t ray_count = std::size_t{1} << 18;
  std::uint64_t seed = 1;
  /// Primary rays through each pixel, one after another as a renderer has them; the more there are, the fewer pixels the picture has. At least 1.
  std::size_t samples_per_pixel = 1;
};

/// The camera of that name; without a name the scene's first or, when it has none, a view of everything. Throws UsageError that lists the
/// scene's cameras.
[[nodiscard]] Camera workload_camera(const Scene& scene, std::string_view name);

/// Makes rays of one kind, but not recorded ones. The same scene and settings give the same rays, whatever the structure and the number of threads.
/// Throws InputError when rays must start on a surface and neither camera nor random rays find one.
[[nodiscard]] std::vector<Ray> make_rays(RayKind kind, const Scene& scene, const SceneAccelerator& accelerator, const Camera& camera,
                                         const WorkloadSettings& settings);

}  // namespace grove
