#include "grove/scene/gltf/meshes.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "grove/scene/gltf/gpu_instances.h"
#include "grove/scene/gltf/materials.h"
#include "grove/scene/gltf/skin.h"
#include "grove/scene/gltf/surface.h"

namespace grove {
namespace {

/// An object that surfaces are added to.
struct ObjectBuilder {
  std::shared_ptr<TriangleMesh> mesh = std::make_shared<TriangleMesh>();
  std::vector<Part> parts;

  void add(GltfSurface surface, std::string name, std::uint32_t material) {
    Part part;
    part.name = std::move(name);
    part.material = material;
    part.normals = std::move(surface.normals);
    part.uvs = std::move(surface.uvs);
    part.second_uvs = std::move(surface.second_uvs);
    part.tangents = std::move(surface.tangents);
    part.colours = std::move(surface.colours);
    mesh->add_part(std::move(surface.vertices), std::move(surface.triangles));
    parts.push_back(std::move(part));
  }

  Object finish(std::string name) { return {std::move(name), std::move(mesh), std::move(parts)}; }
};

class MeshReader {
 public:
  MeshReader(GltfDocument& document, const GltfNodes& nodes, Scene& scene)
      : document_(document), nodes_(nodes), scene_(scene), file_nodes_(document.array("nodes")), file_meshes_(document.array("meshes")) {}

  void run() {
    count_uses();
    ObjectBuilder world;
    for (const GltfNode& node : nodes_.shown) {
      const auto mesh = mesh_of(node);
      if (mesh && !is_instanced(node, *mesh)) bake(node, *mesh, world);
    }
    if (!world.parts.empty()) {
      scene_.objects.push_back(world.finish("world"));
      scene_.instances.push_back({"world", 0, Transform()});
    }
    // By mesh, so that the instances of an object stand together.
    std::map<std::uint32_t, std::vector<const GltfNode*>> instanced;
    for (const GltfNode& node : nodes_.shown) {
      const auto mesh = mesh_of(node);
      if (mesh && is_instanced(node, *mesh)) instanced[*mesh].push_back(&node);
    }
    for (const auto& [mesh, users] : instanced) place(mesh, users);
  }

 private:
  [[nodiscard]] JsonCursor source(const GltfNode& node) const { return file_nodes_.element(node.id); }

  [[nodiscard]] std::optional<std::uint32_t> mesh_of(const GltfNode& node) const {
    return source(node)["mesh"].index(file_meshes_.size(), "meshes");
  }

  // A node's own skin or morph weights give it a shape that other nodes with the same mesh do not have.
  [[nodiscard]] bool has_own_shape(const GltfNode& node) const { return source(node)["skin"].exists() || source(node)["weights"].exists(); }

  void count_uses() {
    uses_.assign(file_meshes_.size(), 0);
    for (const GltfNode& node : nodes_.shown) {
      const auto mesh = mesh_of(node);
      if (mesh && !has_own_shape(node)) ++uses_[*mesh];
    }
  }

  [[nodiscard]] bool is_instanced(const GltfNode& node, std::uint32_t mesh) const {
    return !has_own_shape(node) && (uses_[mesh] > 1 || has_gpu_instances(source(node)));
  }

  [[nodiscard]] std::vector<double> morph_weights(const JsonCursor& mesh, const JsonCursor& node) const {
    const JsonCursor weights = node["weights"].exists() ? node["weights"] : mesh["weights"];
    return weights.numbers(weights.size());
  }

  // Calls `take(surface)` and adds what comes out, for each primitive of a mesh that has triangles.
  template <typename Take>
  void add_primitives(std::uint32_t mesh_id, const std::vector<double>& weights, const GltfSkin* skin, const Take& take,
                      ObjectBuilder& object) {
    const JsonCursor mesh = file_meshes_.element(mesh_id);
    const JsonCursor primitives = mesh["primitives"];
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      const JsonCursor primitive = primitives.element(i);
      // A part's own size, so that nodes cannot repeat long lists of empty primitives for nothing.
      document_.charge(sizeof(Part), primitive);
      GltfSurface surface = read_surface(document_, scene_, primitive, weights, skin);
      if (surface.triangles.empty()) continue;
      take(surface);
      const auto material = primitive["material"].index(document_.array("materials").size(), "materials");
      object.add(std::move(surface), mesh["name"].text(), material ? *material : default_material(document_, scene_));
    }
  }

  void bake(const GltfNode& node, std::uint32_t mesh, ObjectBuilder& world) {
    const JsonCursor node_source = source(node);
    const std::vector<double> weights = morph_weights(file_meshes_.element(mesh), node_source);
    const auto skin_id = node_source["skin"].index(document_.array("skins").size(), "skins");
    if (skin_id) {
      // Joints place a skinned mesh in the world; its node's own transform has no part in it.
      const GltfSkin skin = read_skin(document_, nodes_, *skin_id);
      add_primitives(
          mesh, weights, &skin, [](GltfSurface&) {}, world);
      return;
    }
    add_primitives(
        mesh, weights, nullptr, [&](GltfSurface& surface) { transform_surface(surface, node.to_world); }, world);
  }

  void place(std::uint32_t mesh, const std::vector<const GltfNode*>& users) {
    ObjectBuilder builder;
    const JsonCursor mesh_source = file_meshes_.element(mesh);
    add_primitives(
        mesh, morph_weights(mesh_source, source(*users.front())), nullptr, [](GltfSurface&) {}, builder);
    if (builder.parts.empty()) return;
    const auto object = static_cast<std::uint32_t>(scene_.objects.size());
    scene_.objects.push_back(builder.finish(mesh_source["name"].text()));
    for (const GltfNode* user : users) {
      const JsonCursor node = source(*user);
      const std::string name = node["name"].text();
      if (!has_gpu_instances(node)) {
        add_instance(name, object, user->to_world, node);
        continue;
      }
      for (const Mat4& local : read_gpu_instances(document_, node)) add_instance(name, object, user->to_world * local, node);
    }
  }

  void add_instance(const std::string& name, std::uint32_t object, const Mat4& to_world, const JsonCursor& node) {
    Transform transform(to_world);
    if (!transform.is_invertible()) {
      if (document_.is_first("flat instances")) {
        scene_.warn("instances scaled to nothing along an axis are left out, such as " + node.path());
      }
      return;
    }
    scene_.instances.push_back({name, object, transform});
  }

  GltfDocument& document_;
  const GltfNodes& nodes_;
  Scene& scene_;
  JsonCursor file_nodes_;
  JsonCursor file_meshes_;
  /// How many shown nodes use each mesh in its own shape.
  std::vector<std::uint32_t> uses_;
};

}  // namespace

void read_meshes(GltfDocument& document, const GltfNodes& nodes, Scene& scene) {
  MeshReader(document, nodes, scene).run();
}

}  // namespace grove
