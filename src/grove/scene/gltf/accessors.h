#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "grove/math/vector.h"
#include "grove/scene/gltf/document.h"
#include "grove/scene/gltf/json_cursor.h"

namespace grove {

/// Which elements of an accessor to read: all, or those with the given numbers, in that order.
struct ElementSelection {
  bool all = true;
  /// Strictly increasing; not read when `all`.
  std::span<const std::uint32_t> ids = {};
};

/// Reads typed arrays out of a document's buffers, with byte offsets, strides, normalised integers and sparse replacements, as glTF
/// 2.0 section 3.6.2 says. All reading is checked against the bytes that are there; throws InputError naming the place.
class GltfAccessors {
 public:
  explicit GltfAccessors(GltfDocument& document) : document_(document) {}

  /// Number of elements of the accessor that `place` names, checked against the bytes behind it.
  [[nodiscard]] std::size_t count(const JsonCursor& place) const;

  /// Unsigned integers: vertex indices, joints.
  [[nodiscard]] std::vector<std::uint32_t> integers(const JsonCursor& place) const;

  // Floats, or integers turned into floats. An accessor of other arity is an error, but for `colours`.
  [[nodiscard]] std::vector<float> scalars(const JsonCursor& place, const ElementSelection& elements = {}) const;
  [[nodiscard]] std::vector<Vec2> vec2s(const JsonCursor& place, const ElementSelection& elements = {}) const;
  [[nodiscard]] std::vector<Vec3> vec3s(const JsonCursor& place, const ElementSelection& elements = {}) const;
  [[nodiscard]] std::vector<Vec4> vec4s(const JsonCursor& place, const ElementSelection& elements = {}) const;
  [[nodiscard]] std::vector<Mat4> mat4s(const JsonCursor& place) const;
  /// Three or four components; a missing fourth is 1.
  [[nodiscard]] std::vector<Vec4> colours(const JsonCursor& place, const ElementSelection& elements = {}) const;
  /// Four components as they are, for joint numbers.
  [[nodiscard]] std::vector<glm::u32vec4> integer_vec4s(const JsonCursor& place, const ElementSelection& elements = {}) const;

 private:
  struct Layout;

  [[nodiscard]] Layout layout(const JsonCursor& place) const;
  template <typename Value>
  [[nodiscard]] std::vector<Value> read(const JsonCursor& place, unsigned components, const ElementSelection& elements) const;
  template <typename Value>
  void read_dense(const Layout& layout, const ElementSelection& elements, std::vector<Value>& values) const;
  template <typename Value>
  void replace_sparse(const Layout& layout, const ElementSelection& elements, std::vector<Value>& values) const;

  GltfDocument& document_;
};

}  // namespace grove
