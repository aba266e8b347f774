#include "grove/scene/read_ply.h"

#include <algorithm>

#include "grove/scene/formats/ply_polygons.h"
#include "grove/scene/formats/ply_vertices.h"

namespace grove {
namespace {

// Room to ask for at once: what the file surely holds, or little where only a guess is possible.
std::size_t reservation(const ByteStream& stream, std::uint64_t count) {
  constexpr std::uint64_t unsure = 1U << 20;
  return static_cast<std::size_t>(stream.is_compressed() ? std::min(count, unsure) : count);
}

}  // namespace

PlyMesh read_ply(const std::filesystem::path& file) {
  ByteStream stream(file);
  const PlyHeader header = read_ply_header(stream);
  PlyNumbers numbers(stream, header.encoding);
  std::uint64_t vertex_count = 0;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") vertex_count += element.count;
  }

  PlyMesh mesh;
  PlyPolygons polygons(mesh, vertex_count);
  for (const PlyElement& element : header.elements) {
    const std::size_t reserve = reservation(stream, element.count);
    if (element.properties.empty() && element.name != "vertex") continue;
    if (element.name == "vertex") {
      if (!mesh.vertices.empty()) numbers.fail("more than one element 'vertex'");
      read_ply_vertices(element, stream, numbers, reserve, mesh);
    } else if (element.name == "face" || element.name == "tristrips") {
      polygons.read(element, numbers, mesh.vertices.size() == vertex_count, reserve);
    } else {
      for (std::uint64_t i = 0; i < element.count; ++i) {
        for (const PlyProperty& property : element.properties) numbers.skip(property);
      }
    }
  }
  polygons.finish(numbers);
  return mesh;
}

}  // namespace grove
