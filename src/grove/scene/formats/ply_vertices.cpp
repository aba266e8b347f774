#include "grove/scene/formats/ply_vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>
#include <vector>

namespace grove {
namespace {

// What is kept of a vertex, as positions in one row of floats.
enum Slot : std::uint8_t {
  slot_x,
  slot_y,
  slot_z,
  slot_nx,
  slot_ny,
  slot_nz,
  slot_u,
  slot_v,
  slot_red,
  slot_green,
  slot_blue,
  slot_alpha,
  slot_count
};
using Row = std::array<float, slot_count>;

struct SlotName {
  std::string_view name;
  Slot slot;
};
constexpr std::array<SlotName, 27> kSlotNames{{{"x", slot_x},
                                               {"y", slot_y},
                                               {"z", slot_z},
                                               {"nx", slot_nx},
                                               {"ny", slot_ny},
                                               {"nz", slot_nz},
                                               {"normal_x", slot_nx},
                                               {"normal_y", slot_ny},
                                               {"normal_z", slot_nz},
                                               {"u", slot_u},
                                               {"v", slot_v},
                                               {"s", slot_u},
                                               {"t", slot_v},
                                               {"texture_u", slot_u},
                                               {"texture_v", slot_v},
                                               {"texture_s", slot_u},
                                               {"texture_t", slot_v},
                                               {"red", slot_red},
                                               {"green", slot_green},
                                               {"blue", slot_blue},
                                               {"alpha", slot_alpha},
                                               {"r", slot_red},
                                               {"g", slot_green},
                                               {"b", slot_blue},
                                               {"diffuse_red", slot_red},
                                               {"diffuse_green", slot_green},
                                               {"diffuse_blue", slot_blue}}};

std::optional<Slot> find_slot(std::string_view name) {
  for (const SlotName& entry : kSlotNames) {
    if (entry.name == name) return entry.slot;
  }
  return std::nullopt;
}

// Integer colours are sRGB, as painting and scanning programs write them (IEC 61966-2-1).
float decode_srgb(float value) {
  return value <= 0.04045F ? value / 12.92F : std::pow((value + 0.055F) / 1.055F, 2.4F);
}

/// Where the wanted numbers of a vertex are, and what they are for.
class VertexReader {
 public:
  VertexReader(const PlyElement& element, PlyMesh& mesh) : element_(element), mesh_(mesh) {
    std::size_t offset = 0;
    for (const PlyProperty& property : element.properties) {
      const std::optional<Slot> slot = property.is_list ? std::nullopt : find_slot(property.name);
      const bool is_integer_colour = slot && *slot >= slot_red && !is_ply_float(property.type);
      const float scale = !is_integer_colour ? 1.0F : property.type == PlyType::uint16 ? 1.0F / 65535.0F : 1.0F / 255.0F;
      fields_.push_back({offset, property.type, slot, scale});
      offset += ply_type_size(property.type);
      if (slot) has_[*slot] = true;
      if (slot == slot_red) srgb_ = is_integer_colour;
    }
    has_normals_ = has_[slot_nx] && has_[slot_ny] && has_[slot_nz];
    has_uvs_ = has_[slot_u] && has_[slot_v];
    has_colours_ = has_[slot_red] && has_[slot_green] && has_[slot_blue];
  }

  void read(ByteStream& stream, PlyNumbers& numbers, std::size_t reserve) {
    if (!has_[slot_x] || !has_[slot_y] || !has_[slot_z]) numbers.fail("the vertices have no x, y and z");
    mesh_.vertices.reserve(reserve);
    if (has_normals_) mesh_.normals.reserve(reserve);
    if (has_uvs_) mesh_.uvs.reserve(reserve);
    if (has_colours_) mesh_.colours.reserve(reserve);
    if (numbers.is_text() || element_.has_list()) {
      read_one_by_one(numbers);
    } else {
      read_blocks(stream, numbers.swaps());
    }
  }

 private:
  struct Field {
    std::size_t offset;
    PlyType type;
    std::optional<Slot> slot;
    float scale;
  };

  void read_one_by_one(PlyNumbers& numbers) {
    for (std::uint64_t i = 0; i < element_.count; ++i) {
      Row row{};
      row[slot_alpha] = 1.0F;
      for (std::size_t f = 0; f < fields_.size(); ++f) {
        if (fields_[f].slot) {
          row[*fields_[f].slot] = fields_[f].scale * numbers.next_float(fields_[f].type);
        } else {
          numbers.skip(element_.properties[f]);
        }
      }
      add(row);
    }
  }

  // All rows are equally long, so that many are taken at once.
  void read_blocks(ByteStream& stream, bool swap) {
    std::vector<Field> wanted;
    std::copy_if(fields_.begin(), fields_.end(), std::back_inserter(wanted), [](const Field& f) { return f.slot.has_value(); });
    const std::size_t row_size = element_.row_size();
    const std::uint64_t rows_at_once = ByteStream::kMaxTake / row_size;
    for (std::uint64_t first = 0; first < element_.count; first += rows_at_once) {
      const auto rows = static_cast<std::size_t>(std::min(rows_at_once, element_.count - first));
      const std::byte* data = stream.take(rows * row_size);
      for (std::size_t i = 0; i < rows; ++i, data += row_size) {
        Row row{};
        row[slot_alpha] = 1.0F;
        for (const Field& field : wanted) row[*field.slot] = field.scale * load_ply_float(data + field.offset, field.type, swap);
        add(row);
      }
    }
  }

  void add(const Row& row) {
    mesh_.vertices.emplace_back(row[slot_x], row[slot_y], row[slot_z]);
    if (has_normals_) mesh_.normals.emplace_back(row[slot_nx], row[slot_ny], row[slot_nz]);
    if (has_uvs_) mesh_.uvs.emplace_back(row[slot_u], row[slot_v]);
    if (!has_colours_) return;
    const Vec3 colour(row[slot_red], row[slot_green], row[slot_blue]);
    mesh_.colours.emplace_back(srgb_ ? Vec3(decode_srgb(colour.x), decode_srgb(colour.y), decode_srgb(colour.z)) : colour, row[slot_alpha]);
  }

  const PlyElement& element_;
  PlyMesh& mesh_;
  std::vector<Field> fields_;
  std::array<bool, slot_count> has_{};
  bool has_normals_ = false;
  bool has_uvs_ = false;
  bool has_colours_ = false;
  bool srgb_ = false;
};

}  // namespace

void read_ply_vertices(const PlyElement& element, ByteStream& stream, PlyNumbers& numbers, std::size_t reserve, PlyMesh& mesh) {
  VertexReader(element, mesh).read(stream, numbers, reserve);
}

}  // namespace grove
