#include "grove/scene/builtin/shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace grove {

void add_grid(PartMesh& mesh, const Vec3& corner, const Vec3& edge_u, const Vec3& edge_v, std::uint32_t cells) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const Vec3 normal = glm::normalize(glm::cross(edge_u, edge_v));
  const float scale = 1.0F / static_cast<float>(cells);
  for (std::uint32_t j = 0; j <= cells; ++j) {
    for (std::uint32_t i = 0; i <= cells; ++i) {
      const Vec2 uv(scale * static_cast<float>(i), scale * static_cast<float>(j));
      mesh.vertices.push_back(corner + uv.x * edge_u + uv.y * edge_v);
      mesh.normals.push_back(normal);
      mesh.uvs.push_back(uv);
    }
  }
  for (std::uint32_t j = 0; j < cells; ++j) {
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t a = first + j * (cells + 1) + i;
      const std::uint32_t d = a + cells + 1;
      mesh.triangles.emplace_back(a, a + 1, d + 1);
      mesh.triangles.emplace_back(a, d + 1, d);
    }
  }
}

void add_ground(PartMesh& mesh, const Vec3& centre, float half_width) {
  add_grid(mesh, centre + Vec3(-half_width, 0.0F, half_width), Vec3(2.0F * half_width, 0.0F, 0.0F), Vec3(0.0F, 0.0F, -2.0F * half_width),
           1);
}

PartMesh geodesic_sphere(std::uint32_t level) {
  // Corners of three golden rectangles.
  const float long_side = 0.5F * (1.0F + std::sqrt(5.0F));
  PartMesh mesh;
  for (const float a : {-1.0F, 1.0F}) {
    for (const float b : {-long_side, long_side}) {
      for (const Vec3& corner : {Vec3(a, b, 0.0F), Vec3(0.0F, a, b), Vec3(b, 0.0F, a)}) {
        mesh.vertices.push_back(glm::normalize(corner));
      }
    }
  }
  // Every three corners that are neighbours of each other, wound so that they face outward.
  const auto near = [&](std::uint32_t i, std::uint32_t j) { return glm::dot(mesh.vertices[i], mesh.vertices[j]) > 0.4F; };
  for (std::uint32_t i = 0; i < 12; ++i) {
    for (std::uint32_t j = i + 1; j < 12; ++j) {
      for (std::uint32_t k = j + 1; k < 12; ++k) {
        if (!near(i, j) || !near(j, k) || !near(i, k)) continue;
        const Vec3& a = mesh.vertices[i];
        const bool outward = glm::dot(glm::cross(mesh.vertices[j] - a, mesh.vertices[k] - a), a) > 0.0F;
        mesh.triangles.emplace_back(i, outward ? j : k, outward ? k : j);
      }
    }
  }
  for (std::uint32_t l = 0; l < level; ++l) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [entry, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.vertices.size()));
      if (is_new) mesh.vertices.push_back(glm::normalize(mesh.vertices[a] + mesh.vertices[b]));
      return entry->second;
    };
    std::vector<Triangle> finer;
    finer.reserve(4 * mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) {
      const Triangle m(middle(t.x, t.y), middle(t.y, t.z), middle(t.z, t.x));
      finer.emplace_back(t.x, m.x, m.z);
      finer.emplace_back(m.x, t.y, m.y);
      finer.emplace_back(m.z, m.y, t.z);
      finer.push_back(m);
    }
    mesh.triangles = std::move(finer);
  }
  mesh.normals = mesh.vertices;
  return mesh;
}

void add_spheres(PartMesh& mesh, const PartMesh& sphere, std::span<const SphereSet::Sphere> spheres) {
  mesh.vertices.reserve(mesh.vertices.size() + spheres.size() * sphere.vertices.size());
  mesh.normals.reserve(mesh.vertices.capacity());
  mesh.triangles.reserve(mesh.triangles.size() + spheres.size() * sphere.triangles.size());
  for (const SphereSet::Sphere& s : spheres) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec3& v : sphere.vertices) mesh.vertices.push_back(s.centre + s.radius * v);
    mesh.normals.insert(mesh.normals.end(), sphere.normals.begin(), sphere.normals.end());
    for (const Triangle& t : sphere.triangles) mesh.triangles.push_back(t + first);
  }
}

Frame frame_around(const Vec3& axis) {
  // The coordinate axis that is furthest from `axis`.
  const Vec3 size = glm::abs(axis);
  const Vec3 other = size.x <= size.y && size.x <= size.z ? Vec3(1.0F, 0.0F, 0.0F)
                     : size.y <= size.z                   ? Vec3(0.0F, 1.0F, 0.0F)
                                                          : Vec3(0.0F, 0.0F, 1.0F);
  const Vec3 x = glm::normalize(glm::cross(other, axis));
  return {x, glm::cross(axis, x)};
}

Vec2 unit_circle(double turns) {
  const double angle = turns * 6.283185307179586;
  return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
}

void add_tube(PartMesh& mesh, const Tube& tube) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const std::size_t rings = tube.centres.size();
  const auto tangent = [&](std::size_t i) {
    const std::size_t before = i > 0 ? i - 1 : tube.closed ? rings - 1 : 0;
    const std::size_t after = i + 1 < rings ? i + 1 : tube.closed ? 0 : rings - 1;
    return glm::normalize(tube.centres[after] - tube.centres[before]);
  };
  std::vector<Vec2> circle(tube.sides);
  for (std::uint32_t s = 0; s < tube.sides; ++s) circle[s] = unit_circle(static_cast<double>(s) / tube.sides);

  Vec3 x = frame_around(tangent(0)).x;
  for (std::size_t i = 0; i < rings; ++i) {
    const Vec3 axis = tangent(i);
    x = glm::normalize(x - glm::dot(x, axis) * axis);
    const Vec3 y = glm::cross(axis, x);
    for (const Vec2& c : circle) {
      const Vec3 normal = c.x * x + c.y * y;
      mesh.vertices.push_back(tube.centres[i] + tube.radii[i] * normal);
      mesh.normals.push_back(normal);
    }
  }
  // A closed line brings the frame back turned by some angle; the last ring joins the first at the side that is nearest.
  std::uint32_t turn = 0;
  if (tube.closed) {
    const Vec3 last = mesh.normals[first + (rings - 1) * tube.sides];
    float best = -2.0F;
    for (std::uint32_t s = 0; s < tube.sides; ++s) {
      const float agreement = glm::dot(last, mesh.normals[first + s]);
      if (agreement > best) {
        best = agreement;
        turn = s;
      }
    }
  }
  const std::size_t spans = tube.closed ? rings : rings - 1;
  for (std::size_t i = 0; i < spans; ++i) {
    const bool joins = i + 1 == rings;
    const auto ring = first + static_cast<std::uint32_t>(i) * tube.sides;
    const auto next = joins ? first : ring + tube.sides;
    for (std::uint32_t s = 0; s < tube.sides; ++s) {
      const std::uint32_t s1 = (s + 1) % tube.sides;
      const std::uint32_t n0 = next + (s + (joins ? turn : 0)) % tube.sides;
      const std::uint32_t n1 = next + (s1 + (joins ? turn : 0)) % tube.sides;
      mesh.triangles.emplace_back(ring + s, ring + s1, n1);
      mesh.triangles.emplace_back(ring + s, n1, n0);
    }
  }
}

}  // namespace grove
