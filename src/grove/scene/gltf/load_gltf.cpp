#include <string>

#include "grove/base/error.h"
#include "grove/scene/gltf/document.h"
#include "grove/scene/gltf/lights_cameras.h"
#include "grove/scene/gltf/materials.h"
#include "grove/scene/gltf/meshes.h"
#include "grove/scene/gltf/nodes.h"
#include "grove/scene/load.h"

namespace grove {

Scene load_gltf(const std::filesystem::path& file) {
  GltfDocument document(file);
  Scene scene;
  for (const std::string& extension : ignored_extensions(document)) scene.warn("extension " + extension + " is not supported and left out");
  const JsonCursor variants = document.root().extension("KHR_materials_variants")["variants"];
  if (variants.size() > 0) {
    scene.warn("KHR_materials_variants: the materials that the file shows by itself are taken, and its " + std::to_string(variants.size()) +
               " variants are left out");
  }
  const GltfNodes nodes = read_nodes(document, scene);
  read_materials(document, scene);
  read_meshes(document, nodes, scene);
  read_lights(document, nodes, scene);
  read_cameras(document, nodes, scene);
  scene.validate(document.file());
  return scene;
}

}  // namespace grove
