#include "grove/lab/claims/effort.h"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "grove/render/scene_accelerator.h"
#include "grove/scene/load.h"

namespace grove {
namespace {

/// The geometry as the one object of a scene.
Scene scene_over(const GeometryPointer& geometry) {
  Object object;
  object.parts.emplace_back();
  if (const auto* const mesh = std::get_if<std::shared_ptr<const TriangleMesh>>(&geometry)) {
    object.geometry = std::make_shared<TriangleMesh>(**mesh);
  } else {
    object.geometry = std::make_shared<SphereSet>(*std::get<std::shared_ptr<const SphereSet>>(geometry));
  }
  Scene scene;
  scene.materials.emplace_back();
  scene.objects.push_back(std::move(object));
  scene.instances.emplace_back();
  return scene;
}

}  // namespace

TrialScene scattered_scene(const ScatterSettings& settings, std::size_t ray_count) {
  TrialScene result;
  result.name = fmt::format("{} {} at skew {}", settings.count, name_of(settings.primitive), settings.skew);
  result.scene = scene_over(scatter(settings));
  result.scene.name = result.name;
  result.rays = rays_inside({Vec3(0.0F), Vec3(1.0F)}, ray_count, 2);
  return result;
}

TrialScene named_scene(const std::string& source, RayKind kind, std::size_t ray_count) {
  TrialScene result;
  result.name = source;
  result.scene = load_scene(source);
  const SceneAccelerator accelerator(result.scene, kDefaultSpec);
  result.rays = make_rays(kind, result.scene, accelerator, workload_camera(result.scene, ""), {ray_count, 1});
  return result;
}

std::vector<TrialScene> varied_scenes(std::size_t triangles, RayKind kind, std::size_t ray_count) {
  std::vector<TrialScene> scenes;
  for (const char* const name : {"mount?spheres=false&", "tree?", "sphereflake?shape=triangles&", "soup?", "stadium?"}) {
    TrialScene& scene = scenes.emplace_back(named_scene(fmt::format("builtin:{}triangles={}", name, triangles), kind, ray_count));
    const std::string_view label(name);
    scene.name = std::string(label.substr(0, label.find('?')));
  }
  return scenes;
}

}  // namespace grove
