#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "grove/math/vector.h"
#include "grove/scene/gltf/accessors.h"
#include "grove/scene/gltf/document.h"
#include "grove/scene/gltf/draco.h"

namespace grove {

/// Triangles and vertex attributes of one glTF primitive, plain or Draco-compressed, from indexed or unindexed lists, strips or fans.
/// When a primitive uses few vertices of a large shared array, only those are read, and the triangles count in them.
class VertexSource {
 public:
  /// `primitive` must have triangles (see `has_triangles`). Throws InputError naming the place when an index is out of range.
  VertexSource(GltfDocument& document, const JsonCursor& primitive);

  /// Whether a primitive is made of triangles, not of points or lines.
  [[nodiscard]] static bool has_triangles(const JsonCursor& primitive);

  [[nodiscard]] std::size_t vertex_count() const { return vertex_count_; }
  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }
  /// Indices at the end of a list that make no triangle.
  [[nodiscard]] std::size_t spare_index_count() const { return spare_index_count_; }

  // Attributes of the primitive by name ("NORMAL"); empty when it has none, else one value a vertex.
  [[nodiscard]] std::vector<Vec2> vec2s(std::string_view name) const;
  [[nodiscard]] std::vector<Vec3> vec3s(std::string_view name) const;
  [[nodiscard]] std::vector<Vec4> vec4s(std::string_view name) const;
  [[nodiscard]] std::vector<Vec4> colours(std::string_view name) const;
  [[nodiscard]] std::vector<glm::u32vec4> integer_vec4s(std::string_view name) const;
  /// An accessor outside `attributes` that has the same vertices, such as a morph target's.
  [[nodiscard]] std::vector<Vec3> other_vec3s(const JsonCursor& place) const;

 private:
  void read_plain(GltfDocument& document);
  void read_draco(GltfDocument& document);
  void keep_used_vertices(const std::vector<std::uint32_t>& indices);
  void assemble(const std::vector<std::uint32_t>& indices);
  template <typename FromDraco, typename FromAccessor>
  auto attribute(std::string_view name, const FromDraco& from_draco, const FromAccessor& from_accessor) const;
  template <typename Value>
  std::vector<Value> complete(std::vector<Value> values, const JsonCursor& place) const;

  JsonCursor primitive_;
  GltfAccessors accessors_;
  std::unique_ptr<DracoMesh> draco_;
  std::size_t vertex_count_ = 0;
  std::size_t spare_index_count_ = 0;
  std::vector<Triangle> triangles_;
  /// The vertices in use, when not all are.
  std::vector<std::uint32_t> used_;
};

}  // namespace grove
