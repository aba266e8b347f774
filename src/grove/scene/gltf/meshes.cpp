#include "grove/scene/gltf/meshes.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "grove/math/to_float.h"
#include "grove/scene/animation/animated_scene.h"
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
    part.tangents = std::move(surface.tangents);
    part.colours = std::move(surface.colours);
    mesh->add_part(std::move(surface.vertices), std::move(surface.triangles));
    parts.push_back(std::move(part));
  }

  Object finish(std::string name) { return {std::move(name), std::move(mesh), std::move(parts)}; }
};

class MeshReader {
 public:
  MeshReader(GltfDocument& document, const GltfNodes& nodes, GltfMotion& motion, Scene& scene)
      : document_(document),
        nodes_(nodes),
        motion_(motion),
        scene_(scene),
        file_nodes_(document.array("nodes")),
        file_meshes_(document.array("meshes")) {}

  void run() {
    count_uses();
    ObjectBuilder world;
    for (const GltfNode& node : nodes_.shown) {
      const auto mesh = mesh_of(node);
      if (mesh && !is_instanced(node, *mesh) && !is_alone(node)) bake(node, *mesh, world);
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
    for (const GltfNode& node : nodes_.shown) {
      const auto mesh = mesh_of(node);
      if (mesh && is_alone(node)) stand_alone(node, *mesh);
    }
  }

 private:
  [[nodiscard]] JsonCursor source(const GltfNode& node) const { return file_nodes_.element(node.id); }

  [[nodiscard]] std::optional<std::uint32_t> mesh_of(const GltfNode& node) const {
    return source(node)["mesh"].index(file_meshes_.size(), "meshes");
  }

  // A node's own skin or morph weights give it a shape that other nodes with the same mesh do not have.
  [[nodiscard]] bool has_own_shape(const GltfNode& node) const {
    return source(node)["skin"].exists() || source(node)["weights"].exists() || motion_.morphs(node.id);
  }

  // Whether its shape or, for a shape of its own without a skin, its place changes with time: then it is an object for itself.
  [[nodiscard]] bool is_alone(const GltfNode& node) const {
    if (motion_.morphs(node.id)) return true;
    const auto skin = skin_of(node);
    return skin ? motion_.bends(skins_.at(*skin)) : has_own_shape(node) && motion_.moves(node.id);
  }

  [[nodiscard]] std::optional<std::uint32_t> skin_of(const GltfNode& node) const {
    return source(node)["skin"].index(document_.array("skins").size(), "skins");
  }

  void count_uses() {
    uses_.assign(file_meshes_.size(), 0);
    for (const GltfNode& node : nodes_.shown) {
      const auto mesh = mesh_of(node);
      const auto skin = mesh ? skin_of(node) : std::nullopt;
      if (skin && !skins_.contains(*skin)) skins_.emplace(*skin, read_skin(document_, nodes_.to_world, *skin, scene_));
      if (mesh && !has_own_shape(node)) ++uses_[*mesh];
    }
  }

  [[nodiscard]] bool is_instanced(const GltfNode& node, std::uint32_t mesh) const {
    return !has_own_shape(node) && (uses_[mesh] > 1 || has_gpu_instances(source(node)) || motion_.moves(node.id));
  }

  [[nodiscard]] std::vector<float> morph_weights(const JsonCursor& mesh, const JsonCursor& node) const {
    const JsonCursor weights = node["weights"].exists() ? node["weights"] : mesh["weights"];
    const std::vector<double> numbers = weights.numbers(weights.size());
    std::vector<float> result(numbers.size());
    std::ranges::transform(numbers, result.begin(), to_float);
    return result;
  }

  // Calls `take(surface)` and adds what comes out, for each primitive of a mesh that has triangles.
  template <typename Take>
  void add_primitives(std::uint32_t mesh_id, const GltfShape& shape, const Take& take, ObjectBuilder& object) {
    const JsonCursor mesh = file_meshes_.element(mesh_id);
    const JsonCursor primitives = mesh["primitives"];
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      const JsonCursor primitive = primitives.element(i);
      // A part's own size, so that nodes cannot repeat long lists of empty primitives for nothing.
      document_.charge(sizeof(Part), primitive);
      GltfSurface surface = read_surface(document_, scene_, primitive, shape);
      if (surface.triangles.empty()) continue;
      take(surface);
      const auto material = primitive["material"].index(document_.array("materials").size(), "materials");
      object.add(std::move(surface), mesh["name"].text(), material ? *material : default_material(document_, scene_));
    }
  }

  void bake(const GltfNode& node, std::uint32_t mesh, ObjectBuilder& world) {
    const std::vector<float> weights = morph_weights(file_meshes_.element(mesh), source(node));
    if (const auto skin = skin_of(node)) {
      // Joints place a skinned mesh in the world; its node's own transform has no part in it.
      const std::vector<Mat4> joints = joint_transforms(skins_.at(*skin), nodes_.to_world);
      add_primitives(
          mesh, {weights, joints}, [](GltfSurface&) {}, world);
      return;
    }
    add_primitives(
        mesh, {weights, {}}, [&](GltfSurface& surface) { transform_surface(surface, node.to_world); }, world);
  }

  void stand_alone(const GltfNode& node, std::uint32_t mesh) {
    const auto skin = skin_of(node);
    DeformingObject deforming;
    deforming.node = node.id;
    deforming.rest_weights = morph_weights(file_meshes_.element(mesh), source(node));
    const std::vector<Mat4> joints = skin ? joint_transforms(skins_.at(*skin), nodes_.to_world) : std::vector<Mat4>();
    ObjectBuilder builder;
    add_primitives(
        mesh, {deforming.rest_weights, joints, true},
        [&](GltfSurface& surface) { deforming.parts.push_back(std::move(*surface.undeformed)); }, builder);
    if (builder.parts.empty()) return;
    const auto object = static_cast<std::uint32_t>(scene_.objects.size());
    const std::string name = source(node)["name"].text();
    scene_.objects.push_back(builder.finish(name));
    if (!skin) motion_.follow_instance(node.id, scene_.instances.size(), Mat4(1.0F));
    scene_.instances.push_back({name, object, skin ? Transform() : Transform(node.to_world)});
    if (!motion_.morphs(node.id) && !skin) return;
    deforming.object = object;
    motion_.add_object(std::move(deforming), skin ? std::optional(skins_.at(*skin)) : std::nullopt);
  }

  void place(std::uint32_t mesh, const std::vector<const GltfNode*>& users) {
    ObjectBuilder builder;
    const JsonCursor mesh_source = file_meshes_.element(mesh);
    const std::vector<float> weights = morph_weights(mesh_source, source(*users.front()));
    add_primitives(
        mesh, {weights, {}}, [](GltfSurface&) {}, builder);
    if (builder.parts.empty()) return;
    const auto object = static_cast<std::uint32_t>(scene_.objects.size());
    scene_.objects.push_back(builder.finish(mesh_source["name"].text()));
    for (const GltfNode* user : users) {
      const JsonCursor node = source(*user);
      const std::string name = node["name"].text();
      if (!has_gpu_instances(node)) {
        add_instance(name, object, *user, Mat4(1.0F));
        continue;
      }
      for (const Mat4& local : read_gpu_instances(document_, node)) add_instance(name, object, *user, local);
    }
  }

  void add_instance(const std::string& name, std::uint32_t object, const GltfNode& node, const Mat4& in_node) {
    const Transform transform(node.to_world * in_node);
    // One that moves may be something at another time.
    if (!transform.is_invertible() && !motion_.moves(node.id)) {
      if (document_.is_first("flat instances")) {
        scene_.warn("instances scaled to nothing along an axis are left out, such as " + source(node).path());
      }
      return;
    }
    motion_.follow_instance(node.id, scene_.instances.size(), in_node);
    scene_.instances.push_back({name, object, transform});
  }

  GltfDocument& document_;
  const GltfNodes& nodes_;
  GltfMotion& motion_;
  Scene& scene_;
  JsonCursor file_nodes_;
  JsonCursor file_meshes_;
  /// How many shown nodes use each mesh in its own shape.
  std::vector<std::uint32_t> uses_;
  /// Those of the meshes that are shown, by number.
  std::map<std::uint32_t, Skin> skins_;
};

}  // namespace

void read_meshes(GltfDocument& document, const GltfNodes& nodes, GltfMotion& motion, Scene& scene) {
  MeshReader(document, nodes, motion, scene).run();
}

}  // namespace grove
