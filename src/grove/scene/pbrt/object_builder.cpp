#include "grove/scene/pbrt/object_builder.h"

#include <algorithm>
#include <exception>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "grove/base/parallel.h"
#include "grove/scene/pbrt/shapes.h"

namespace grove::pbrt {
namespace {

/// A shape on its way into an object.
struct PlacedShape {
  const ShapeDirective* directive = nullptr;
  Matrix to_target{1.0};
  std::uint32_t material = 0;
  ShapeGeometry geometry;
  Warnings warnings;
  std::exception_ptr error;
};

void warn_of_unused(const ShapeDirective& shape, Warnings& warnings) {
  for (const Parameter& p : shape.parameters.own()) {
    if (!p.used) warnings.add(p.place, "the shape \"" + shape.type + "\" has no parameter \"" + p.name + "\"");
  }
}

// Of several errors the first in the file is thrown, whichever thread was quicker.
void build_geometry(std::vector<PlacedShape>& shapes, const MaterialBuilder& materials, Context& context) {
  // Small, because one file may take as long as a hundred others.
  constexpr std::size_t kShapesPerTask = 4;
  parallel_for(shapes.size(), kShapesPerTask, [&](std::size_t i) {
    PlacedShape& shape = shapes[i];
    Context own{context.directory, shape.warnings, context.quadric_steps};
    try {
      shape.geometry = build_shape(*shape.directive, shape.to_target, materials.is_textured(shape.material), own);
      if (!shape.geometry.mesh.triangles.empty() || shape.geometry.sphere) warn_of_unused(*shape.directive, shape.warnings);
    } catch (...) {
      shape.error = std::current_exception();
    }
  });
  for (const PlacedShape& shape : shapes) {
    if (shape.error) std::rethrow_exception(shape.error);
    context.warnings.merge(shape.warnings);
  }
}

std::shared_ptr<TriangleMesh> join_meshes(std::vector<PlacedShape>& shapes, std::vector<Part>& parts) {
  std::size_t vertex_count = 0, triangle_count = 0;
  for (const PlacedShape& shape : shapes) {
    vertex_count += shape.geometry.mesh.vertices.size();
    triangle_count += shape.geometry.mesh.triangles.size();
  }
  if (triangle_count == 0) return nullptr;
  auto mesh = std::make_shared<TriangleMesh>();
  for (PlacedShape& shape : shapes) {
    ShapeMesh part_mesh = std::exchange(shape.geometry.mesh, {});
    if (part_mesh.triangles.empty()) continue;
    if (parts.empty()) {
      // The first part's arrays become the mesh's: with room for all, the parts that follow are copied once.
      part_mesh.vertices.reserve(vertex_count);
      part_mesh.triangles.reserve(triangle_count);
    }
    mesh->add_part(std::move(part_mesh.vertices), std::move(part_mesh.triangles));
    Part part;
    part.name = shape.directive->type;
    part.material = shape.material;
    part.normals = std::move(part_mesh.normals);
    part.uvs = std::move(part_mesh.uvs);
    part.tangents = std::move(part_mesh.tangents);
    parts.push_back(std::move(part));
  }
  return mesh;
}

// Spheres that follow each other with one material and orientation share a part.
std::shared_ptr<SphereSet> join_spheres(const std::vector<PlacedShape>& shapes, std::vector<Part>& parts) {
  auto set = std::make_shared<SphereSet>();
  std::vector<SphereSet::Sphere> pending;
  const auto flush = [&] {
    if (!pending.empty()) set->add_part(std::exchange(pending, {}));
  };
  for (const PlacedShape& shape : shapes) {
    if (!shape.geometry.sphere) continue;
    const bool flip = shape.directive->reverse_orientation;
    if (parts.empty() || parts.back().material != shape.material || parts.back().flip_orientation != flip) {
      flush();
      Part part;
      part.name = "sphere";
      part.material = shape.material;
      part.flip_orientation = flip;
      parts.push_back(std::move(part));
    }
    pending.push_back(*shape.geometry.sphere);
  }
  flush();
  return parts.empty() ? nullptr : set;
}

/// Adds the objects that shapes make and returns their numbers.
std::vector<std::uint32_t> add_objects(std::vector<PlacedShape> shapes, const std::string& name, MaterialBuilder& materials, Scene& scene,
                                       Context& context) {
  for (PlacedShape& shape : shapes) shape.material = materials.material_of(*shape.directive);
  build_geometry(shapes, materials, context);
  std::vector<std::uint32_t> ids;
  const auto add = [&](auto geometry, std::vector<Part> parts, const char* suffix) {
    if (geometry == nullptr) return;
    ids.push_back(static_cast<std::uint32_t>(scene.objects.size()));
    Object object;
    object.name = name + suffix;
    object.geometry = std::move(geometry);
    object.parts = std::move(parts);
    scene.objects.push_back(std::move(object));
  };
  std::vector<Part> mesh_parts, sphere_parts;
  auto mesh = join_meshes(shapes, mesh_parts);
  auto spheres = join_spheres(shapes, sphere_parts);
  add(std::move(mesh), std::move(mesh_parts), "");
  add(std::move(spheres), std::move(sphere_parts), " spheres");
  return ids;
}

std::map<std::string_view, std::size_t> objects_by_name(const Description& description) {
  std::map<std::string_view, std::size_t> ids;
  for (std::size_t i = 0; i < description.objects.size(); ++i) ids.emplace(description.objects[i].name, i);
  return ids;
}

// 5.6 degrees a step put the silhouette of a sphere within 0.12 % of its radius. A line of text makes 4,096 triangles then, so scenes of
// very many quadrics get coarser ones.
std::uint32_t quadric_steps(const Description& description) {
  std::size_t count = 0;
  const auto add = [&count](const std::vector<ShapeDirective>& shapes) {
    for (const ShapeDirective& shape : shapes) count += shape.type == "sphere" || shape.type == "disk" || shape.type == "cylinder";
  };
  add(description.shapes);
  for (const ObjectDefinition& object : description.objects) add(object.shapes);
  return count <= 1000 ? 64 : count <= 20000 ? 32 : 16;
}

}  // namespace

void build_objects(const Description& description, MaterialBuilder& materials, Scene& scene, Context& context) {
  context.quadric_steps = quadric_steps(description);
  const auto ids = objects_by_name(description);
  std::vector<std::vector<const ObjectUse*>> uses(description.objects.size());
  for (const ObjectUse& use : description.uses) {
    const auto found = ids.find(use.name);
    if (found == ids.end()) use.place.fail("no ObjectBegin defines \"" + use.name + "\"");
    if (is_usable(use.to_world)) {
      uses[found->second].push_back(&use);
    } else {
      context.warnings.add(use.place, "an instance under a transform that is singular, projective or not finite is left out");
    }
  }

  std::vector<PlacedShape> world;
  const auto place = [](std::vector<PlacedShape>& list, const ShapeDirective& shape, const Matrix& outer) {
    PlacedShape& placed = list.emplace_back();
    placed.directive = &shape;
    placed.to_target = outer * shape.to_world;
  };
  for (const ShapeDirective& shape : description.shapes) place(world, shape, Matrix(1.0));
  for (std::size_t i = 0; i < uses.size(); ++i) {
    if (uses[i].size() != 1) continue;
    for (const ShapeDirective& shape : description.objects[i].shapes) place(world, shape, uses[i][0]->to_world);
  }
  for (const std::uint32_t id : add_objects(std::move(world), "world", materials, scene, context)) {
    scene.instances.push_back({.name = scene.objects[id].name, .object = id, .object_to_world = Transform()});
  }

  for (std::size_t i = 0; i < uses.size(); ++i) {
    if (uses[i].size() < 2) continue;
    const ObjectDefinition& definition = description.objects[i];
    std::vector<PlacedShape> shapes;
    for (const ShapeDirective& shape : definition.shapes) place(shapes, shape, Matrix(1.0));
    for (const std::uint32_t id : add_objects(std::move(shapes), definition.name, materials, scene, context)) {
      for (const ObjectUse* use : uses[i]) {
        scene.instances.push_back({.name = scene.objects[id].name, .object = id, .object_to_world = Transform(Mat4(use->to_world))});
      }
    }
  }
}

}  // namespace grove::pbrt
