// Draco's own library decodes. Before it sees the bytes, the number of triangles is read from the bitstream's header here, because the
// library allocates for what the header claims.
#include "grove/scene/gltf/draco.h"

#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>

#include <array>
#include <cstring>
#include <limits>
#include <optional>
#include <string>

namespace grove {
namespace {

// Regular meshes come down to a few bits a triangle; a byte for 32 triangles is beyond what quantised positions allow.
constexpr std::uint64_t kTrianglesPerByte = 32;
constexpr std::uint8_t kTriangularMesh = 1;
constexpr std::uint8_t kEdgebreaker = 1;
constexpr std::uint16_t kHasMetadata = 0x8000;

/// Takes the numbers off the start of a Draco bitstream (draft specification 2.2, sections 2 to 4).
class HeaderReader {
 public:
  HeaderReader(std::span<const std::byte> data, const JsonCursor& place) : data_(data), place_(place) {}

  /// Checks what the header says, and returns the number of triangles that it claims.
  std::uint64_t triangle_count() {
    constexpr std::string_view kMagic = "DRACO";
    if (data_.size() < kMagic.size() || std::memcmp(data_.data(), kMagic.data(), kMagic.size()) != 0) place_.fail("is not Draco data");
    data_ = data_.subspan(kMagic.size());
    const unsigned major = take_byte();
    const unsigned minor = take_byte();
    if (major != 2 || minor != 2) {
      place_.fail("Draco bitstream " + std::to_string(major) + "." + std::to_string(minor) + "; glTF has 2.2");
    }
    if (take_byte() != kTriangularMesh) place_.fail("Draco data that is not a triangle mesh");
    const std::uint8_t method = take_byte();
    const unsigned low = take_byte();
    const unsigned flags = low | (static_cast<unsigned>(take_byte()) << 8);
    if ((flags & kHasMetadata) != 0) place_.fail("Draco data with metadata is not read; export the scene without it");
    // Edgebreaker puts its traversal and the number of vertices first.
    if (method == kEdgebreaker) {
      take_byte();
      take_varint();
    }
    return take_varint();
  }

 private:
  std::uint8_t take_byte() {
    if (data_.empty()) place_.fail("Draco data that is cut short");
    const auto value = std::to_integer<std::uint8_t>(data_.front());
    data_ = data_.subspan(1);
    return value;
  }

  std::uint64_t take_varint() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 35; shift += 7) {
      const std::uint8_t byte = take_byte();
      value |= std::uint64_t{byte & 0x7fU} << shift;
      if ((byte & 0x80U) == 0) return value;
    }
    place_.fail("Draco data with a broken count");
  }

  std::span<const std::byte> data_;
  const JsonCursor& place_;
};

}  // namespace

struct DracoMesh::Decoded {
  std::unique_ptr<draco::Mesh> mesh;
};

DracoMesh::DracoMesh(std::span<const std::byte> data, const JsonCursor& place) : decoded_(std::make_unique<Decoded>()) {
  const std::uint64_t claimed = HeaderReader(data, place).triangle_count();
  if (claimed > kTrianglesPerByte * data.size()) {
    place.fail("Draco data of " + std::to_string(data.size()) + " bytes that claims " + std::to_string(claimed) + " triangles");
  }
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(data.data()), data.size());
  draco::Decoder decoder;
  auto result = decoder.DecodeMeshFromBuffer(&buffer);
  if (!result.ok()) place.fail("Draco data that cannot be decoded: " + result.status().error_msg_string());
  decoded_->mesh = std::move(result).value();
}

DracoMesh::~DracoMesh() = default;

std::size_t DracoMesh::vertex_count() const {
  return decoded_->mesh->num_points();
}

std::vector<Triangle> DracoMesh::triangles() const {
  std::vector<Triangle> triangles(decoded_->mesh->num_faces());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const draco::Mesh::Face& face = decoded_->mesh->face(draco::FaceIndex(static_cast<std::uint32_t>(i)));
    triangles[i] = {face[0].value(), face[1].value(), face[2].value()};
  }
  return triangles;
}

template <typename Value, typename Component, int kComponents>
std::vector<Value> DracoMesh::read(const JsonCursor& place) const {
  const std::uint64_t id = place.whole();
  const draco::PointAttribute* attribute =
      id > std::numeric_limits<std::uint32_t>::max() ? nullptr : decoded_->mesh->GetAttributeByUniqueId(static_cast<std::uint32_t>(id));
  if (attribute == nullptr) place.fail("names attribute " + std::to_string(id) + ", which the Draco data does not have");
  std::vector<Value> values(vertex_count());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const draco::AttributeValueIndex value_id = attribute->mapped_index(draco::PointIndex(static_cast<std::uint32_t>(i)));
    std::array<Component, 4> components{0, 0, 0, 1};
    if (value_id.value() >= attribute->size() ||
        !attribute->ConvertValue<Component>(value_id, static_cast<std::int8_t>(std::min<int>(kComponents, attribute->num_components())),
                                            components.data())) {
      place.fail("the Draco data has no value for vertex " + std::to_string(i));
    }
    for (int c = 0; c < kComponents; ++c) values[i][c] = components[static_cast<std::size_t>(c)];
  }
  return values;
}

std::vector<Vec2> DracoMesh::vec2s(const JsonCursor& place) const {
  return read<Vec2, float, 2>(place);
}
std::vector<Vec3> DracoMesh::vec3s(const JsonCursor& place) const {
  return read<Vec3, float, 3>(place);
}
std::vector<Vec4> DracoMesh::vec4s(const JsonCursor& place) const {
  return read<Vec4, float, 4>(place);
}
std::vector<glm::u32vec4> DracoMesh::integer_vec4s(const JsonCursor& place) const {
  return read<glm::u32vec4, std::uint32_t, 4>(place);
}

}  // namespace grove
