#include "grove/render/prepared_scene.h"

#include <algorithm>

namespace grove {
namespace {

bool shines(const Scene& scene, std::uint32_t object) {
  return std::ranges::any_of(scene.objects[object].parts, [&](const Part& part) { return scene.materials[part.material].is_emissive(); });
}

}  // namespace

void PreparedScene::follow(const SceneChanges& changes) {
  if (changes.has_geometry()) surfaces = SurfaceTable(scene);
  // How far light from infinitely far counts for `power` is told by the bounds of all there is.
  const bool moves_lights =
      changes.lights || (lights.sampling() == LightSampling::power && changes.has_geometry()) ||
      std::ranges::any_of(changes.objects, [&](std::uint32_t object) { return shines(scene, object); }) ||
      std::ranges::any_of(changes.instances, [&](std::uint32_t instance) { return shines(scene, scene.instances[instance].object); });
  if (moves_lights) lights.gather();
}

}  // namespace grove
