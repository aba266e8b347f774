#include <optional>
#include <string>
#include <utility>

#include "grove/base/error.h"
#include "grove/scene/gltf/animations.h"
#include "grove/scene/gltf/document.h"
#include "grove/scene/gltf/lights_cameras.h"
#include "grove/scene/gltf/materials.h"
#include "grove/scene/gltf/meshes.h"
#include "grove/scene/gltf/motion.h"
#include "grove/scene/gltf/nodes.h"
#include "grove/scene/load.h"
#include "grove/scene/load_animated.h"

namespace grove {
namespace {

Scene begin_scene(const GltfDocument& document) {
  Scene scene;
  for (const std::string& extension : ignored_extensions(document)) scene.warn("extension " + extension + " is not supported and left out");
  return scene;
}

void fill_scene(GltfDocument& document, const GltfNodes& nodes, GltfMotion& motion, Scene& scene) {
  read_materials(document, scene);
  read_meshes(document, nodes, motion, scene);
  read_lights(document, nodes, scene, motion);
  read_cameras(document, nodes, scene, motion);
  scene.validate(document.file());
}

}  // namespace

Scene load_gltf(const std::filesystem::path& file) {
  GltfDocument document(file);
  Scene scene = begin_scene(document);
  const GltfNodes nodes = read_nodes(document, scene);
  GltfMotion nothing(nodes);
  fill_scene(document, nodes, nothing, scene);
  return scene;
}

AnimatedScene load_animated_gltf(const std::filesystem::path& file, const std::string& choice) {
  GltfDocument document(file);
  Scene scene = begin_scene(document);
  const GltfNodes nodes = read_nodes(document, scene);
  std::optional<SceneAnimation> animation = read_animation(document, nodes, choice, scene);
  GltfMotion motion = animation ? GltfMotion(nodes, std::move(*animation)) : GltfMotion(nodes);
  fill_scene(document, nodes, motion, scene);
  animation = motion.finish();
  if (!animation) return AnimatedScene(std::move(scene));
  return {std::move(scene), std::move(*animation)};
}

}  // namespace grove
