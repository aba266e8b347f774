#include "grove/scene/gltf/vertex_source.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

namespace grove {
namespace {

enum class Mode : std::uint8_t { points, lines, line_loop, line_strip, triangles, triangle_strip, triangle_fan };

Mode read_mode(const JsonCursor& primitive) {
  const std::uint64_t mode = primitive["mode"].whole(static_cast<std::uint64_t>(Mode::triangles));
  if (mode > static_cast<std::uint64_t>(Mode::triangle_fan)) primitive["mode"].fail("is " + std::to_string(mode) + ", not a mode");
  return static_cast<Mode>(mode);
}

}  // namespace

VertexSource::VertexSource(GltfDocument& document, const JsonCursor& primitive) : primitive_(primitive), accessors_(document) {
  if (primitive.extension("KHR_draco_mesh_compression").exists()) {
    read_draco(document);
  } else {
    read_plain(document);
  }
}

bool VertexSource::has_triangles(const JsonCursor& primitive) {
  return read_mode(primitive) >= Mode::triangles;
}

void VertexSource::read_plain(GltfDocument& document) {
  const JsonCursor position = primitive_["attributes"]["POSITION"];
  if (!position.exists()) position.fail("is missing");
  vertex_count_ = accessors_.count(position);
  if (vertex_count_ >= std::numeric_limits<std::uint32_t>::max()) position.fail("more than 2^32 - 2 vertices; split the mesh");
  const JsonCursor index_place = primitive_["indices"];
  std::vector<std::uint32_t> indices;
  if (index_place.exists()) {
    indices = accessors_.integers(index_place);
    const auto largest = std::max_element(indices.begin(), indices.end());
    if (largest != indices.end() && *largest >= vertex_count_) {
      index_place.fail("index " + std::to_string(*largest) + ", but there are only " + std::to_string(vertex_count_) + " vertices");
    }
  } else {
    document.charge(std::uint64_t{vertex_count_} * sizeof(std::uint32_t), position);
    indices.resize(vertex_count_);
    std::iota(indices.begin(), indices.end(), 0U);
  }
  // Fewer indices than vertices: some vertices are certainly not used.
  if (indices.size() < vertex_count_) keep_used_vertices(indices);
  if (!used_.empty()) {
    for (std::uint32_t& index : indices) {
      index = static_cast<std::uint32_t>(std::lower_bound(used_.begin(), used_.end(), index) - used_.begin());
    }
  }
  document.charge(std::uint64_t{indices.size()} * sizeof(Triangle), primitive_);
  assemble(indices);
}

void VertexSource::keep_used_vertices(const std::vector<std::uint32_t>& indices) {
  used_ = indices;
  std::sort(used_.begin(), used_.end());
  used_.erase(std::unique(used_.begin(), used_.end()), used_.end());
  vertex_count_ = used_.size();
}

void VertexSource::assemble(const std::vector<std::uint32_t>& indices) {
  const Mode mode = read_mode(primitive_);
  const std::size_t count = indices.size();
  if (mode == Mode::triangles) {
    spare_index_count_ = count % 3;
    triangles_.reserve(count / 3);
    for (std::size_t i = 0; i + 2 < count; i += 3) triangles_.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
    return;
  }
  spare_index_count_ = count < 3 ? count : 0;
  for (std::size_t i = 0; i + 2 < count; ++i) {
    if (mode == Mode::triangle_fan) {
      triangles_.emplace_back(indices[i + 1], indices[i + 2], indices[0]);
    } else {
      // Every other triangle of a strip has its corners the other way round (glTF 2.0 section 3.7.2.1).
      triangles_.emplace_back(indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]);
    }
  }
}

void VertexSource::read_draco(GltfDocument& document) {
  const JsonCursor view = primitive_.extension("KHR_draco_mesh_compression")["bufferView"];
  const std::uint32_t id = view.required_index(document.array("bufferViews").size(), "buffer views");
  // The library takes strips apart: what it returns are triangles whatever the mode.
  draco_ = std::make_unique<DracoMesh>(document.view(id), view);
  vertex_count_ = draco_->vertex_count();
  triangles_ = draco_->triangles();
  document.charge(std::uint64_t{triangles_.size()} * sizeof(Triangle) + std::uint64_t{vertex_count_} * sizeof(Vec3), view);
  for (const Triangle& triangle : triangles_) {
    if (std::max({triangle.x, triangle.y, triangle.z}) >= vertex_count_) view.fail("Draco data with an index out of range");
  }
}

template <typename Value>
std::vector<Value> VertexSource::complete(std::vector<Value> values, const JsonCursor& place) const {
  if (values.size() == vertex_count_) return values;
  place.fail("has " + std::to_string(values.size()) + " values for " + std::to_string(vertex_count_) + " vertices");
}

template <typename FromDraco, typename FromAccessor>
auto VertexSource::attribute(std::string_view name, const FromDraco& from_draco, const FromAccessor& from_accessor) const {
  using Values = decltype(from_accessor(primitive_, ElementSelection{}));
  if (draco_) {
    const JsonCursor compressed = primitive_.extension("KHR_draco_mesh_compression")["attributes"][name];
    if (compressed.exists()) return complete(Values(from_draco(compressed)), compressed);
  }
  const JsonCursor place = primitive_["attributes"][name];
  if (!place.exists()) return Values();
  return complete(Values(from_accessor(place, ElementSelection{.all = used_.empty(), .ids = used_})), place);
}

std::vector<Vec2> VertexSource::vec2s(std::string_view name) const {
  return attribute(
      name, [&](const JsonCursor& place) { return draco_->vec2s(place); },
      [&](const JsonCursor& place, const ElementSelection& elements) { return accessors_.vec2s(place, elements); });
}

std::vector<Vec3> VertexSource::vec3s(std::string_view name) const {
  return attribute(
      name, [&](const JsonCursor& place) { return draco_->vec3s(place); },
      [&](const JsonCursor& place, const ElementSelection& elements) { return accessors_.vec3s(place, elements); });
}

std::vector<Vec4> VertexSource::vec4s(std::string_view name) const {
  return attribute(
      name, [&](const JsonCursor& place) { return draco_->vec4s(place); },
      [&](const JsonCursor& place, const ElementSelection& elements) { return accessors_.vec4s(place, elements); });
}

std::vector<Vec4> VertexSource::colours(std::string_view name) const {
  return attribute(
      name, [&](const JsonCursor& place) { return draco_->vec4s(place); },
      [&](const JsonCursor& place, const ElementSelection& elements) { return accessors_.colours(place, elements); });
}

std::vector<glm::u32vec4> VertexSource::integer_vec4s(std::string_view name) const {
  return attribute(
      name, [&](const JsonCursor& place) { return draco_->integer_vec4s(place); },
      [&](const JsonCursor& place, const ElementSelection& elements) { return accessors_.integer_vec4s(place, elements); });
}

std::vector<Vec3> VertexSource::other_vec3s(const JsonCursor& place) const {
  return complete(accessors_.vec3s(place, ElementSelection{.all = used_.empty(), .ids = used_}), place);
}

}  // namespace grove
