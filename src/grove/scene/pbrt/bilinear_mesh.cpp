// Bilinear patches: two triangles where the four corners lie in a plane, else a grid of them.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "grove/scene/pbrt/shapes.h"

namespace grove::pbrt {
namespace {

using Corners = std::array<std::uint32_t, 4>;  // at (u, v) = (0, 0), (1, 0), (0, 1), (1, 1)

std::vector<Corners> read_patches(const ParameterList& parameters, std::size_t vertex_count) {
  const std::span<const std::int32_t> indices = parameters.integers("indices");
  if (indices.empty()) {
    if (vertex_count == 4) return {{0, 1, 2, 3}};
    parameters.place().fail("a bilinearmesh of other than four points needs \"integer indices\"");
  }
  const Place& place = parameters.find("indices", ParameterType::integer)->place;
  if (indices.size() % 4 != 0) place.fail("\"indices\" has " + std::to_string(indices.size()) + " values, not a multiple of 4");
  std::vector<Corners> patches(indices.size() / 4);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] < 0 || static_cast<std::size_t>(indices[i]) >= vertex_count)
      place.fail("index " + std::to_string(indices[i]) + " is out of range: the mesh has " + std::to_string(vertex_count) + " points");
    patches[i / 4][i % 4] = static_cast<std::uint32_t>(indices[i]);
  }
  return patches;
}

bool is_planar(const std::array<Vec3, 4>& p) {
  const glm::dvec3 a(p[1] - p[0]), b(p[2] - p[0]), c(p[3] - p[0]);
  const double size = std::sqrt(std::max({glm::dot(a, a), glm::dot(b, b), glm::dot(c, c)}));
  // Written so that NaN counts as planar: such triangles are never hit, so two are enough.
  return !(std::abs(glm::dot(glm::cross(a, b), c)) > 1e-5 * size * size * size);
}

template <typename Value>
Value blend(const std::array<Value, 4>& corners, float u, float v) {
  return (1.0F - v) * ((1.0F - u) * corners[0] + u * corners[1]) + v * ((1.0F - u) * corners[2] + u * corners[3]);
}

template <typename Value>
std::array<Value, 4> at_corners(const std::vector<Value>& values, const Corners& c) {
  return {values[c[0]], values[c[1]], values[c[2]], values[c[3]]};
}

// du x dv of the patch.
Vec3 patch_normal(const std::array<Vec3, 4>& p, float u, float v) {
  const Vec3 du = (1.0F - v) * (p[1] - p[0]) + v * (p[3] - p[2]);
  const Vec3 dv = (1.0F - u) * (p[2] - p[0]) + u * (p[3] - p[1]);
  return glm::cross(du, dv);
}

// Fine enough for a smooth look where there are few patches; many patches are a fine mesh already.
std::uint32_t steps_for(std::size_t patch_count) {
  return patch_count <= 256 ? 16 : patch_count <= 4096 ? 8 : 4;
}

}  // namespace

ShapeMesh make_bilinear_mesh(const ParameterList& parameters, Context& context) {
  const std::vector<Vec3> points = parameters.vectors3("P");
  if (points.empty()) parameters.place().fail("the mesh has no \"point3 P\"");
  const std::vector<Vec3> normals = parameters.vectors3("N");
  const std::vector<Vec2> uvs = parameters.vectors2("uv");
  if (!normals.empty() && normals.size() != points.size()) parameters.find("N")->place.fail("\"N\" needs one entry a point");
  if (!uvs.empty() && uvs.size() != points.size()) parameters.find("uv")->place.fail("\"uv\" needs one entry a point");
  if (parameters.find("emissionfilename") != nullptr)
    context.warnings.add(parameters.place(), "\"emissionfilename\" of a bilinearmesh is left out; it emits evenly");
  parameters.ignore("faceIndices");  // numbers for per-face textures, which nothing here has

  ShapeMesh mesh;
  const std::vector<Corners> patches = read_patches(parameters, points.size());
  for (const Corners& corners : patches) {
    const std::array<Vec3, 4> p = at_corners(points, corners);
    const std::uint32_t steps = is_planar(p) ? 1 : steps_for(patches.size());
    append_grid(mesh, steps, steps, [&](std::uint32_t i, std::uint32_t j) {
      const float u = static_cast<float>(i) / static_cast<float>(steps);
      const float v = static_cast<float>(j) / static_cast<float>(steps);
      return SurfacePoint{blend(p, u, v), normals.empty() ? patch_normal(p, u, v) : blend(at_corners(normals, corners), u, v),
                          uvs.empty() ? Vec2(u, v) : blend(at_corners(uvs, corners), u, v)};
    });
  }
  return mesh;
}

}  // namespace grove::pbrt
