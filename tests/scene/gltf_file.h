#pragma once

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "grove/math/vector.h"

namespace grove {

/// Puts a small glTF file together: JSON by hand, arrays by functions that return the numbers of accessors and the like.
struct GltfFile {
  using Json = nlohmann::json;

  Json json = {{"asset", {{"version", "2.0"}}},
               {"scene", 0},
               {"scenes", {{{"nodes", Json::array()}}}},
               {"accessors", Json::array()},
               {"bufferViews", Json::array()},
               {"meshes", Json::array()},
               {"nodes", Json::array()}};
  std::string binary;

  template <typename Value>
  int add_view(const std::vector<Value>& values) {
    while (binary.size() % 4 != 0) binary += '\0';
    const std::size_t size = values.size() * sizeof(Value);
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", size}});
    binary.append(reinterpret_cast<const char*>(values.data()), size);
    return static_cast<int>(json["bufferViews"].size()) - 1;
  }

  int add_accessor(int view, int component_type, std::size_t count, const char* type) {
    json["accessors"].push_back({{"bufferView", view}, {"componentType", component_type}, {"count", count}, {"type", type}});
    return static_cast<int>(json["accessors"].size()) - 1;
  }

  int add(const std::vector<float>& v) { return add_accessor(add_view(v), 5126, v.size(), "SCALAR"); }
  int add(const std::vector<Vec2>& v) { return add_accessor(add_view(v), 5126, v.size(), "VEC2"); }
  int add(const std::vector<Vec3>& v) { return add_accessor(add_view(v), 5126, v.size(), "VEC3"); }
  int add(const std::vector<Vec4>& v) { return add_accessor(add_view(v), 5126, v.size(), "VEC4"); }
  int add(const std::vector<Mat4>& v) { return add_accessor(add_view(v), 5126, v.size(), "MAT4"); }
  int add(const std::vector<std::uint16_t>& v) { return add_accessor(add_view(v), 5123, v.size(), "SCALAR"); }

  int add_mesh(const Json& primitive) {
    json["meshes"].push_back({{"primitives", {primitive}}});
    return static_cast<int>(json["meshes"].size()) - 1;
  }

  /// (0,0,0), (1,0,0), (0,1,0), with an index buffer.
  int add_triangle() {
    const int position = add(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const int indices = add(std::vector<std::uint16_t>{0, 1, 2});
    return add_mesh({{"attributes", {{"POSITION", position}}}, {"indices", indices}});
  }

  /// A node that the scene shows.
  int add_node(const Json& node) {
    const int id = add_child(node);
    json["scenes"][0]["nodes"].push_back(id);
    return id;
  }

  /// A node that nothing shows yet.
  int add_child(const Json& node) {
    json["nodes"].push_back(node);
    return static_cast<int>(json["nodes"].size()) - 1;
  }

  static std::string u32(std::size_t value) {
    std::string bytes(4, '\0');
    for (std::size_t i = 0; i < 4; ++i) bytes[i] = static_cast<char>(value >> (8 * i));
    return bytes;
  }

  std::string glb() const {
    Json document = json;
    if (!binary.empty()) document["buffers"] = {{{"byteLength", binary.size()}}};
    std::string text = document.dump();
    while (text.size() % 4 != 0) text += ' ';
    std::string padded = binary;
    while (padded.size() % 4 != 0) padded += '\0';
    std::string chunks = u32(text.size()) + "JSON" + text;
    if (!binary.empty()) chunks += u32(padded.size()) + std::string("BIN\0", 4) + padded;
    return "glTF" + u32(2) + u32(12 + chunks.size()) + chunks;
  }

  /// Writes `name`.gltf, with the buffer in a file of that name.
  std::filesystem::path write_text(const std::filesystem::path& folder, const std::string& buffer_name, const std::string& uri) const {
    Json document = json;
    document["buffers"] = {{{"byteLength", binary.size()}, {"uri", uri}}};
    if (!buffer_name.empty()) std::ofstream(folder / buffer_name, std::ios::binary) << binary;
    std::ofstream(folder / "scene.gltf") << document.dump();
    return folder / "scene.gltf";
  }
};

/// How many damaged files a test tries: GROVE_FUZZ_VARIANTS in the environment makes it longer than the usual.
inline int fuzz_variants(int usual) {
  const char* wish = std::getenv("GROVE_FUZZ_VARIANTS");
  return wish == nullptr ? usual : std::atoi(wish);
}

/// A PNG of 2 x 2 pixels, RGB: red and green above, blue and white below; one stored deflate block.
inline std::vector<std::uint8_t> small_png() {
  return {0x89, 'P',  'N',  'G',  0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 'I',  'H',  'D',  'R',  0x00, 0x00, 0x00, 0x02, 0x00,
          0x00, 0x00, 0x02, 0x08, 0x02, 0x00, 0x00, 0x00, 0xfd, 0xd4, 0x9a, 0x73, 0x00, 0x00, 0x00, 0x19, 'I',  'D',  'A',  'T',  0x78,
          0x01, 0x01, 0x0e, 0x00, 0xf1, 0xff, 0x00, 0xff, 0x00, 0x00, 0x00, 0xff, 0x00, 0x00, 0x00, 0x00, 0xff, 0xff, 0xff, 0xff, 0x1f,
          0xee, 0x05, 0xfb, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 'I',  'E',  'N',  'D',  0xae, 0x42, 0x60, 0x82};
}

}  // namespace grove
