#include "trace/world_mesh.h"

#include <utility>

#include "grove/base/error.h"

namespace grove::bench {

std::shared_ptr<const TriangleMesh> world_mesh(const Scene& scene) {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (const Instance& instance : scene.instances) {
    const auto* mesh = std::get_if<std::shared_ptr<TriangleMesh>>(&scene.objects[instance.object].geometry);
    if (mesh == nullptr) continue;
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const Vec3& v : (*mesh)->vertices())
      vertices.push_back(instance.object_to_world.is_identity() ? v : instance.object_to_world.point(v));
    for (const Triangle& triangle : (*mesh)->triangles()) triangles.push_back(triangle + first);
  }
  if (triangles.empty()) throw InputError(scene.name, "", "has no triangles; this benchmark needs some");
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

Scene scene_of(const Scene& scene, const std::shared_ptr<const TriangleMesh>& mesh) {
  Scene result;
  result.name = scene.name;
  result.materials.emplace_back();
  result.objects.push_back({"world", std::make_shared<TriangleMesh>(*mesh), {Part{}}});
  result.instances.push_back({"world", 0, Transform()});
  result.cameras = scene.cameras;
  result.film = scene.film;
  return result;
}

}  // namespace grove::bench
