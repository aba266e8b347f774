#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "grove/math/vector.h"
#include "grove/scene/gltf/json_cursor.h"

namespace grove {

/// The mesh in a KHR_draco_mesh_compression buffer view.
class DracoMesh {
 public:
  /// Decodes `data`. Throws InputError at `place` when it is not a Draco mesh of bitstream 2.2 (the one that glTF allows), or claims more
  /// triangles than so many bytes can hold.
  DracoMesh(std::span<const std::byte> data, const JsonCursor& place);
  ~DracoMesh();
  DracoMesh(const DracoMesh&) = delete;
  DracoMesh& operator=(const DracoMesh&) = delete;

  [[nodiscard]] std::size_t vertex_count() const;
  [[nodiscard]] std::vector<Triangle> triangles() const;

  // The attribute whose unique id `place` holds, for each vertex. Missing components are 0, a missing fourth is 1 (as in a colour).
  [[nodiscard]] std::vector<Vec2> vec2s(const JsonCursor& place) const;
  [[nodiscard]] std::vector<Vec3> vec3s(const JsonCursor& place) const;
  [[nodiscard]] std::vector<Vec4> vec4s(const JsonCursor& place) const;
  [[nodiscard]] std::vector<glm::u32vec4> integer_vec4s(const JsonCursor& place) const;

 private:
  template <typename Value, typename Component, int kComponents>
  [[nodiscard]] std::vector<Value> read(const JsonCursor& place) const;

  struct Decoded;
  std::unique_ptr<Decoded> decoded_;
};

}  // namespace grove
