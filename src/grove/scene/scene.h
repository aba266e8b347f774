#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "grove/geometry/sphere_set.h"
#include "grove/geometry/triangle_mesh.h"
#include "grove/math/transform.h"
#include "grove/math/vector.h"
#include "grove/scene/camera.h"
#include "grove/scene/image.h"
#include "grove/scene/light.h"
#include "grove/scene/material.h"
#include "grove/scene/texture.h"

namespace grove {

/// One surface with one material: a part of an object's geometry, with the same number.
struct Part {
  std::string name;
  std::uint32_t material = 0;  ///< index into Scene::materials
  /// Per vertex of the part (local numbering: mesh vertex minus first_vertex), each either empty or complete.
  std::vector<Vec3> normals;
  std::vector<Vec2> uvs;
  std::vector<Vec2> second_uvs;  ///< for textures with uv_set 1; empty where no texture asks for them
  std::vector<Vec4> tangents;    ///< w is the handedness of the bitangent, as in glTF
  std::vector<Vec4> colours;     ///< linear, multiplies the base colour and alpha
  /// The shading normal's side where a surface has no vertex normals follows the winding; true turns it over (pbrt ReverseOrientation).
  bool flip_orientation = false;
};

/// Something that a ray can hit, placed by instances: triangles or spheres, in parts.
struct Object {
  std::string name;
  std::variant<std::shared_ptr<TriangleMesh>, std::shared_ptr<SphereSet>> geometry;
  std::vector<Part> parts;  ///< one for each part of the geometry

  /// Number of triangles or spheres.
  [[nodiscard]] std::size_t primitive_count() const {
    return std::visit([](const auto& set) { return set->size(); }, geometry);
  }
};

/// An object under a transform.
struct Instance {
  std::string name;
  std::uint32_t object = 0;
  Transform object_to_world;
};

/// What a file asks of the picture; 0 means that it does not say.
struct FilmRequest {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

/// A whole scene in memory, in world units, y up or as the file has it. Loaders flatten what appears once into one object in world
/// space with an identity instance (one structure over all of it), and keep as objects of their own what is instanced.
struct Scene {
  std::string name;
  std::vector<Object> objects;
  std::vector<Instance> instances;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<std::shared_ptr<const Image>> images;
  std::vector<PunctualLight> lights;
  Environment environment;
  std::vector<Camera> cameras;
  FilmRequest film;
  /// One line for each kind of thing that was left out or mended, in the order first met.
  std::vector<std::string> warnings;
  double load_seconds = 0.0;

  /// Primitives with every instance counted; `stored_primitive_count` counts each object once.
  [[nodiscard]] std::uint64_t primitive_count() const;
  [[nodiscard]] std::uint64_t stored_primitive_count() const;
  /// World bounds over all instances; primitives that can never be hit do not count.
  [[nodiscard]] Box bounds() const;
  /// Adds a warning unless the same line is there already.
  void warn(std::string line);
  /// Throws InputError unless every index is in range, every part is complete, and there is something to hit ("nothing renderable").
  void validate(std::string_view file) const;
};

}  // namespace grove
