#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "grove/base/error.h"
#include "grove/base/random.h"
#include "grove/scene/formats/mesh_scene.h"
#include "grove/scene/load.h"
#include "grove/scene/read_file.h"

namespace grove {
namespace {

constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kPreambleBytes = kHeaderBytes + 4;
constexpr std::size_t kTriangleBytes = 50;

// Little-endian, on any machine.
std::uint32_t announced_triangles(const std::vector<std::byte>& data) {
  std::uint32_t count = 0;
  for (std::size_t i = 4; i-- > 0;) count = (count << 8) | std::to_integer<std::uint32_t>(data[kHeaderBytes + i]);
  return count;
}

std::size_t count_words(std::string_view text, std::string_view word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + word.size())) ++count;
  return count;
}

// Many binary files begin with "solid" too, so the exact length decides first.
bool is_binary(const std::vector<std::byte>& data) {
  return data.size() >= kPreambleBytes && data.size() == kPreambleBytes + kTriangleBytes * std::uint64_t{announced_triangles(data)};
}

void check_text(const std::string& name, std::string_view text) {
  const std::size_t line_end = std::min(text.find('\0'), text.size());
  if (line_end != text.size()) {
    throw InputError(name, "byte " + std::to_string(line_end),
                     "neither text nor as long as a binary STL file of its triangle count; it is cut short or broken");
  }
  const std::size_t facets = count_words(text, "endfacet");
  if (facets == 0) throw InputError(name, "", "nothing renderable: the STL file has no facets");
  // "endfacet" holds "facet", so whole facets count twice.
  const std::size_t vertices = count_words(text, "vertex");
  if (count_words(text, "facet") != 2 * facets || vertices != 3 * facets || text.find("endsolid") == std::string_view::npos) {
    throw InputError(name, "",
                     "the STL text is cut short or broken: " + std::to_string(vertices) + " vertices in " + std::to_string(facets) +
                         " whole facets, or no endsolid");
  }
}

// Nothing unchecked goes to Assimp: sizes and counts agree, or this throws.
void check(const std::string& name, const std::vector<std::byte>& data) {
  if (data.empty()) throw InputError(name, "byte 0", "the file is empty");
  if (is_binary(data)) {
    if (announced_triangles(data) == 0) throw InputError(name, "", "nothing renderable: the STL file has no triangles");
    return;
  }
  const std::string_view text(reinterpret_cast<const char*>(data.data()), data.size());
  const std::size_t first = std::min(text.find_first_not_of(" \t\r\n"), text.size());
  if (text.substr(first).starts_with("solid")) return check_text(name, text);
  if (data.size() < kPreambleBytes) {
    throw InputError(name, "byte " + std::to_string(data.size()), "too short for an STL file, which begins with 84 bytes or 'solid'");
  }
  const std::uint64_t announced = announced_triangles(data);
  throw InputError(name, "byte 80",
                   "the STL file announces " + std::to_string(announced) + " triangles, which take " +
                       std::to_string(kPreambleBytes + kTriangleBytes * announced) + " bytes, but it has " + std::to_string(data.size()));
}

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

}  // namespace

Scene load_stl(const std::filesystem::path& file) {
  const std::string name = file.string();
  SharedVertices vertices;
  std::vector<Triangle> triangles;
  {
    const std::vector<std::byte> data = read_file(file);
    check(name, data);
    Assimp::Importer importer;
    const aiScene* const read = importer.ReadFileFromMemory(data.data(), data.size(), aiProcess_DropNormals, "stl");
    if (read == nullptr) throw InputError(name, "", std::string("cannot be read as STL: ") + importer.GetErrorString());
    for (unsigned m = 0; m < read->mNumMeshes; ++m) {
      const aiMesh& mesh = *read->mMeshes[m];
      for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
        const aiFace& face = mesh.mFaces[i];
        if (face.mNumIndices != 3) continue;
        Triangle triangle(0);
        for (int corner = 0; corner < 3; ++corner) {
          const aiVector3D& p = mesh.mVertices[face.mIndices[corner]];
          triangle[corner] = vertices.add({p.x, p.y, p.z});
        }
        triangles.push_back(triangle);
      }
    }
  }
  const std::size_t dropped = drop_unhittable(vertices.points, triangles);
  Part part;
  part.name = file.stem().string();
  Scene scene = single_mesh_scene(TriangleMesh(std::move(vertices.points), std::move(triangles)), std::move(part), default_material());
  if (dropped > 0) scene.warn(unhittable_warning(dropped));
  return scene;
}

}  // namespace grove
