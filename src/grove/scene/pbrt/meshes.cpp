// The shapes that are triangles already: trianglemesh, plymesh, and loopsubdiv as its control mesh.

#include <string>
#include <utility>

#include "grove/scene/pbrt/shapes.h"
#include "grove/scene/read_ply.h"

namespace grove::pbrt {
namespace {

std::vector<Triangle> read_triangles(const ParameterList& parameters, std::size_t vertex_count) {
  const std::span<const std::int32_t> indices = parameters.integers("indices");
  if (indices.empty()) {
    if (vertex_count == 3) return {Triangle(0, 1, 2)};
    parameters.place().fail("a mesh of other than three points needs \"integer indices\"");
  }
  const Place& place = parameters.find("indices", ParameterType::integer)->place;
  if (indices.size() % 3 != 0) place.fail("\"indices\" has " + std::to_string(indices.size()) + " values, not a multiple of 3");
  std::vector<Triangle> triangles;
  triangles.reserve(indices.size() / 3);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] < 0 || static_cast<std::size_t>(indices[i]) >= vertex_count)
      place.fail("index " + std::to_string(indices[i]) + " is out of range: the mesh has " + std::to_string(vertex_count) + " points");
    if (i % 3 == 2) triangles.emplace_back(indices[i - 2], indices[i - 1], indices[i]);
  }
  return triangles;
}

template <typename Value>
std::vector<Value> one_per_vertex(std::vector<Value> values, const ParameterList& parameters, const char* name, std::size_t count) {
  if (values.empty() || values.size() == count) return values;
  parameters.find(name)->place.fail("\"" + std::string(name) + "\" has " + std::to_string(values.size()) + " entries for " +
                                    std::to_string(count) + " points");
}

std::vector<Vec2> read_uvs(const ParameterList& parameters, std::size_t count) {
  for (const char* name : {"uv", "st"}) {
    std::vector<Vec2> uvs = parameters.vectors2(name);
    if (!uvs.empty()) return one_per_vertex(std::move(uvs), parameters, name, count);
  }
  return {};
}

}  // namespace

ShapeMesh make_triangle_mesh(const ParameterList& parameters) {
  ShapeMesh mesh;
  mesh.vertices = parameters.vectors3("P");
  if (mesh.vertices.empty()) parameters.place().fail("the mesh has no \"point3 P\"");
  const std::size_t count = mesh.vertices.size();
  mesh.triangles = read_triangles(parameters, count);
  mesh.normals = one_per_vertex(parameters.vectors3("N"), parameters, "N", count);
  mesh.uvs = read_uvs(parameters, count);
  for (const Vec3& tangent : one_per_vertex(parameters.vectors3("S"), parameters, "S", count)) mesh.tangents.emplace_back(tangent, 1.0F);
  parameters.ignore("faceIndices");  // numbers for per-face textures, which nothing here has
  return mesh;
}

ShapeMesh make_ply_mesh(const ParameterList& parameters, Context& context) {
  const std::string name = parameters.text("filename", "");
  if (name.empty()) parameters.place().fail("plymesh has no \"string filename\"");
  if (parameters.find("displacement") != nullptr)
    context.warnings.add(parameters.place(), "displacement of a plymesh is left out; the mesh stays as it is");
  parameters.ignore("edgelength");  // only displacement looks at it
  PlyMesh ply = read_ply(resolve_file(context.directory, name));
  ShapeMesh mesh;
  mesh.vertices = std::move(ply.vertices);
  mesh.normals = std::move(ply.normals);
  mesh.uvs = std::move(ply.uvs);
  mesh.triangles = std::move(ply.triangles);
  return mesh;
}

ShapeMesh make_control_mesh(const ParameterList& parameters, Context& context) {
  context.warnings.add(parameters.place(), "loopsubdiv is shown as its control mesh, without subdivision");
  for (const char* name : {"levels", "nlevels", "scheme"}) parameters.ignore(name);
  ShapeMesh mesh;
  mesh.vertices = parameters.vectors3("P");
  if (mesh.vertices.empty()) parameters.place().fail("the mesh has no \"point3 P\"");
  mesh.triangles = read_triangles(parameters, mesh.vertices.size());
  return mesh;
}

}  // namespace grove::pbrt
