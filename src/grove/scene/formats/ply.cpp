#include <utility>

#include "grove/base/error.h"
#include "grove/scene/formats/mesh_scene.h"
#include "grove/scene/load.h"
#include "grove/scene/read_ply.h"

namespace grove {

Scene load_ply(const std::filesystem::path& file) {
  PlyMesh ply = read_ply(file);
  if (ply.triangles.empty()) {
    const std::string count = std::to_string(ply.vertices.size());
    throw InputError(file.string(), "", "nothing renderable: " + count + " vertices but no faces; make a mesh of the points first");
  }
  const std::size_t dropped = drop_unhittable(ply.vertices, ply.triangles);
  mend_normals(ply.vertices, ply.triangles, ply.normals);

  Part part;
  part.name = file.stem().string();
  part.normals = std::move(ply.normals);
  part.uvs = std::move(ply.uvs);
  part.colours = std::move(ply.colours);
  Material material = default_material();
  if (!part.colours.empty()) material.base_colour.value = Vec3(1.0F);
  Scene scene = single_mesh_scene(TriangleMesh(std::move(ply.vertices), std::move(ply.triangles)), std::move(part), material);
  if (dropped > 0) scene.warn(unhittable_warning(dropped));
  return scene;
}

}  // namespace grove
