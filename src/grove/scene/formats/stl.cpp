#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "grove/base/error.h"
#include "grove/base/random.h"
#include "grove/scene/formats/mesh_scene.h"
#include "grove/scene/formats/text.h"
#include "grove/scene/load.h"
#include "grove/scene/read_file.h"

namespace grove {
namespace {

constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kPreambleBytes = kHeaderBytes + 4;
constexpr std::size_t kNormalBytes = 12;
constexpr std::size_t kTriangleBytes = 50;  // normal, three corners, two bytes of attributes

/// STL repeats every vertex; those with the same bits become one, so that the surface is one piece.
struct SharedVertices {
  struct Hash {
    std::size_t operator()(const std::array<std::uint32_t, 3>& bits) const {
      return mix_bits(mix_bits((std::uint64_t{bits[0]} << 32) | bits[1]) ^ bits[2]);
    }
  };

  std::uint32_t add(const Vec3& p) {
    const std::array<std::uint32_t, 3> bits{std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y),
                                            std::bit_cast<std::uint32_t>(p.z)};
    const auto [entry, is_new] = ids.try_emplace(bits, static_cast<std::uint32_t>(points.size()));
    if (is_new) points.push_back(p);
    return entry->second;
  }

  std::vector<Vec3> points;
  std::unordered_map<std::array<std::uint32_t, 3>, std::uint32_t, Hash> ids;
};

// Little-endian, on any machine.
std::uint32_t load_u32(const std::byte* data) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = (value << 8) | std::to_integer<std::uint32_t>(data[i]);
  return value;
}

void read_binary(const std::vector<std::byte>& data, SharedVertices& vertices, std::vector<Triangle>& triangles) {
  const std::uint32_t count = load_u32(&data[kHeaderBytes]);
  triangles.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::byte* at = &data[kPreambleBytes + kTriangleBytes * i + kNormalBytes];
    Triangle triangle(0);
    for (int corner = 0; corner < 3; ++corner) {
      Vec3 p(0.0F);
      for (int axis = 0; axis < 3; ++axis, at += 4) p[axis] = std::bit_cast<float>(load_u32(at));
      triangle[corner] = vertices.add(p);
    }
    triangles.push_back(triangle);
  }
}

/// The text form: one keyword a line. The normals of facets are not read: the order of the corners says the same.
class TextReader {
 public:
  TextReader(const std::string& name, std::string_view text) : name_(name), text_(text) {}

  void read(SharedVertices& vertices, std::vector<Triangle>& triangles) {
    bool ended = false;
    std::size_t corners = 0;
    Triangle triangle(0);
    while (next_line()) {
      const std::string keyword = next_word();
      if (keyword == "vertex") {
        if (corners == 3) fail("a facet of more than three corners");
        triangle[static_cast<int>(corners++)] = vertices.add(next_point());
      } else if (keyword == "endfacet") {
        if (corners != 3) fail("a facet of " + std::to_string(corners) + " corners");
        triangles.push_back(triangle);
        corners = 0;
      } else if (keyword == "endsolid") {
        ended = true;
      } else if (keyword != "facet" && keyword != "outer" && keyword != "endloop" && keyword != "solid" && !keyword.empty()) {
        if (text_.empty() && !ended) break;  // half a word at the end of the file
        fail("unknown keyword " + quote(keyword));
      }
    }
    if (!ended || corners != 0) fail("the file ends here without endsolid; it is cut short");
  }

 private:
  [[noreturn]] void fail(std::string_view problem) const { throw InputError(name_, "line " + std::to_string(line_number_), problem); }

  bool next_line() {
    if (text_.empty()) return false;
    line_ = text_.substr(0, text_.find('\n'));
    text_.remove_prefix(line_.size() < text_.size() ? line_.size() + 1 : text_.size());
    ++line_number_;
    return true;
  }

  // In lower case, because some programs write capitals.
  std::string next_word() {
    constexpr std::string_view space = " \t\r";
    line_.remove_prefix(std::min(line_.find_first_not_of(space), line_.size()));
    std::string word(line_.substr(0, line_.find_first_of(space)));
    line_.remove_prefix(word.size());
    for (char& c : word) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return word;
  }

  Vec3 next_point() {
    Vec3 p(0.0F);
    for (int axis = 0; axis < 3; ++axis) {
      const std::string word = next_word();
      const std::optional<float> value = parse_float(word);
      if (!value) fail(quote(word) + " is not a number");
      p[axis] = *value;
    }
    return p;
  }

  const std::string& name_;
  std::string_view text_;  // what is not read yet
  std::string_view line_;
  std::uint64_t line_number_ = 0;
};

void read_stl(const std::string& name, const std::vector<std::byte>& data, SharedVertices& vertices, std::vector<Triangle>& triangles) {
  if (data.empty()) throw InputError(name, "byte 0", "the file is empty");
  const std::uint64_t announced = data.size() >= kPreambleBytes ? load_u32(&data[kHeaderBytes]) : 0;
  const std::uint64_t binary_bytes = kPreambleBytes + kTriangleBytes * announced;
  // Many binary files begin with "solid" too, so the exact length decides first.
  if (data.size() == binary_bytes) return read_binary(data, vertices, triangles);

  const std::string_view text(reinterpret_cast<const char*>(data.data()), data.size());
  const std::string_view start = text.substr(std::min(text.find_first_not_of(" \t\r\n"), text.size()), 5);
  if (start == "solid" || start == "SOLID") {
    const std::size_t zero = text.find('\0');
    if (zero != std::string_view::npos) {
      throw InputError(name, "byte " + std::to_string(zero),
                       "neither text nor as long as a binary STL file of its triangle count; it is cut short or broken");
    }
    return TextReader(name, text).read(vertices, triangles);
  }
  if (data.size() < kPreambleBytes) {
    throw InputError(name, "byte " + std::to_string(data.size()), "too short for an STL file, which begins with 84 bytes or 'solid'");
  }
  throw InputError(name, "byte 80",
                   "the STL file announces " + std::to_string(announced) + " triangles, which take " + std::to_string(binary_bytes) +
                       " bytes, but it has " + std::to_string(data.size()));
}

}  // namespace

Scene load_stl(const std::filesystem::path& file) {
  const std::string name = file.string();
  SharedVertices vertices;
  std::vector<Triangle> triangles;
  read_stl(name, read_file(file), vertices, triangles);
  if (triangles.empty()) throw InputError(name, "", "nothing renderable: the STL file has no triangles");
  vertices.ids = {};
  const std::size_t dropped = drop_unhittable(vertices.points, triangles);
  Part part;
  part.name = file.stem().string();
  Scene scene = single_mesh_scene(TriangleMesh(std::move(vertices.points), std::move(triangles)), std::move(part), default_material());
  if (dropped > 0) scene.warn(unhittable_warning(dropped));
  return scene;
}

}  // namespace grove
