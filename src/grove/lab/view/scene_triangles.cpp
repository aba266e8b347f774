#include "grove/lab/view/scene_triangles.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

#include "grove/base/random.h"
#include "grove/lab/view/packed_bytes.h"

namespace grove {
namespace {

constexpr std::uint64_t kMostLookedAt = 16'000'000;
constexpr std::uint32_t kFinest = 65536;

/// An octahedron.
constexpr std::array<std::array<float, 3>, 6> kSphereCorners{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
constexpr std::array<std::array<std::uint8_t, 3>, 8> kSphereFaces{
    {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};

using Point = SceneTriangles::Point;
using Corners = std::array<Point, 3>;

std::uint64_t count_triangles(const Object& object) {
  const bool has_spheres = std::holds_alternative<std::shared_ptr<SphereSet>>(object.geometry);
  return object.primitive_count() * (has_spheres ? 4 * kSphereFaces.size() : 1);
}

/// Calls show(a, b, c) for the pieces of a sphere: each face of an octahedron cut in four and pushed out.
template <typename Show>
void cut_sphere(const SphereSet::Sphere& sphere, const Show& show) {
  const auto out = [&](const Vec3& direction) { return sphere.centre + sphere.radius * glm::normalize(direction); };
  for (const auto& face : kSphereFaces) {
    std::array<Vec3, 3> corner;
    for (std::size_t i = 0; i < 3; ++i) corner[i] = {kSphereCorners[face[i]][0], kSphereCorners[face[i]][1], kSphereCorners[face[i]][2]};
    std::array<Vec3, 3> middle;
    for (std::size_t i = 0; i < 3; ++i) middle[i] = out(corner[i] + corner[(i + 1) % 3]);
    for (std::size_t i = 0; i < 3; ++i) show(out(corner[i]), middle[i], middle[(i + 2) % 3]);
    show(middle[0], middle[1], middle[2]);
  }
}

/// Calls show(a, b, c) for one in `one_in` of the primitives, in world space.
template <typename Show>
void for_triangles(const Scene& scene, std::uint64_t one_in, const Show& show) {
  std::uint64_t number = 0;
  for (const Instance& instance : scene.instances) {
    const Transform& place = instance.object_to_world;
    const Object& object = scene.objects[instance.object];
    const auto show_placed = [&](const Vec3& a, const Vec3& b, const Vec3& c) { show(place.point(a), place.point(b), place.point(c)); };
    for (std::size_t i = 0; i < object.primitive_count(); ++i) {
      if (number++ % one_in != 0) continue;
      if (const auto* const mesh = std::get_if<std::shared_ptr<TriangleMesh>>(&object.geometry)) {
        if ((*mesh)->bounds(i).is_empty()) continue;
        const Triangle& triangle = (*mesh)->triangles()[i];
        const std::span<const Vec3> vertices = (*mesh)->vertices();
        show_placed(vertices[triangle.x], vertices[triangle.y], vertices[triangle.z]);
      } else {
        const SphereSet& spheres = *std::get<std::shared_ptr<SphereSet>>(object.geometry);
        if (!spheres.bounds(i).is_empty()) cut_sphere(spheres.sphere(i), show_placed);
      }
    }
  }
}

/// The cells of a grid that corners fall in, as one number each.
class Grid {
 public:
  explicit Grid(const Box& bounds, std::uint32_t size) {
    const Vec3 extent = bounds.extent();
    const float longest = std::max({extent.x, extent.y, extent.z});
    for (int axis = 0; axis < 3; ++axis) {
      // Cells are cubes; steps are of the box.
      const double cells = longest > 0.0F ? static_cast<double>(size) * double{extent[axis]} / double{longest} : 0.0;
      cells_[axis] = std::max(1.0, cells);
    }
  }

  [[nodiscard]] std::uint64_t cell(const Point& point) const {
    std::uint64_t cell = 0;
    for (int axis = 0; axis < 3; ++axis)
      cell = cell << 20U | static_cast<std::uint64_t>(static_cast<double>(point[static_cast<std::size_t>(axis)]) /
                                                      double{Quantiser::kSteps} * (cells_[axis] - 1e-6));
    return cell;
  }

 private:
  double cells_[3];
};

struct HashCells {
  std::size_t operator()(const std::array<std::uint64_t, 3>& cells) const {
    return static_cast<std::size_t>(mix_bits(cells[0] ^ mix_bits(cells[1] ^ mix_bits(cells[2]))));
  }
};

/// The corners' cells from the lowest; empty where two share one.
std::array<std::uint64_t, 3> cells_of(const Grid& grid, const Corners& corners, bool& is_flat) {
  std::array<std::uint64_t, 3> cells{grid.cell(corners[0]), grid.cell(corners[1]), grid.cell(corners[2])};
  std::ranges::sort(cells);
  is_flat = cells[0] == cells[1] || cells[1] == cells[2];
  return cells;
}

/// How many triangles are left on a grid; counting ends at `enough`.
std::size_t count_left(const std::vector<Corners>& corners, const Grid& grid, std::size_t enough) {
  std::unordered_set<std::array<std::uint64_t, 3>, HashCells> left;
  for (const Corners& triangle : corners) {
    bool is_flat = false;
    const auto cells = cells_of(grid, triangle, is_flat);
    if (!is_flat && left.insert(cells).second && left.size() > enough) break;
  }
  return left.size();
}

/// The finest grid on which at most `most` triangles are left.
std::uint32_t choose_grid(const std::vector<Corners>& corners, const Box& bounds, std::size_t most) {
  constexpr double kStep = 1.2;
  double size = 16.0;
  while (size * kStep < kFinest && count_left(corners, Grid(bounds, static_cast<std::uint32_t>(size * kStep)), most) <= most) size *= kStep;
  return static_cast<std::uint32_t>(size);
}

}  // namespace

SceneTriangles triangles_of(const Scene& scene, std::size_t most) {
  SceneTriangles result;
  result.bounds = scene.bounds();
  for (const Instance& instance : scene.instances) result.total += count_triangles(scene.objects[instance.object]);
  result.one_in = (result.total + kMostLookedAt - 1) / kMostLookedAt;
  result.one_in = std::max<std::uint64_t>(result.one_in, 1);

  const Quantiser quantiser(result.bounds);
  const auto quantise = [&](const Vec3& p) {
    return Point{quantiser.nearest(0, p.x), quantiser.nearest(1, p.y), quantiser.nearest(2, p.z)};
  };
  std::vector<Corners> corners;
  corners.reserve(result.total / result.one_in + 1);
  for_triangles(scene, result.one_in, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    corners.push_back({quantise(a), quantise(b), quantise(c)});
  });

  if (corners.size() > most) result.grid = choose_grid(corners, result.bounds, most);
  const Grid grid(result.bounds, result.grid == 0 ? kFinest : result.grid);
  struct Cell {
    std::uint32_t vertex;
    std::uint32_t count;
    std::array<std::uint64_t, 3> sum;
  };
  std::unordered_map<std::uint64_t, Cell> cells;
  std::unordered_set<std::array<std::uint64_t, 3>, HashCells> kept;
  for (const Corners& triangle : corners) {
    bool is_flat = false;
    if (!kept.insert(cells_of(grid, triangle, is_flat)).second && result.grid != 0) continue;
    if (is_flat) continue;
    std::array<std::uint32_t, 3> indices{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto next = static_cast<std::uint32_t>(cells.size());
      Cell& cell = cells.try_emplace(grid.cell(triangle[i]), Cell{next, 0, {0, 0, 0}}).first->second;
      ++cell.count;
      for (std::size_t axis = 0; axis < 3; ++axis) cell.sum[axis] += triangle[i][axis];
      indices[i] = cell.vertex;
    }
    result.triangles.push_back(indices);
  }
  result.vertices.resize(cells.size());
  for (const auto& [number, cell] : cells) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      result.vertices[cell.vertex][axis] = static_cast<std::uint16_t>(cell.sum[axis] / cell.count);
  }
  return result;
}

}  // namespace grove
