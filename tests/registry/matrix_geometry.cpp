#include "registry/matrix_geometry.h"

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "grove/base/random.h"

namespace grove::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Vec3 random_point(Random& random) {
  return {random.next_float(), random.next_float(), random.next_float()};
}

TriangleMesh scaled(const TriangleMesh& mesh, float scale, const Vec3& offset) {
  std::vector<Vec3> vertices(mesh.vertices().begin(), mesh.vertices().end());
  for (Vec3& v : vertices) v = v * scale + offset;
  return {std::move(vertices), {mesh.triangles().begin(), mesh.triangles().end()}};
}

// A grid of squares in one axis plane, all coplanar; neighbours share edges that lie in the plane.
TriangleMesh flat_grid(int n, int axis) {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) {
      Vec3 v(0.5F);
      v[(axis + 1) % 3] = static_cast<float>(x) / static_cast<float>(n);
      v[(axis + 2) % 3] = static_cast<float>(y) / static_cast<float>(n);
      vertices.push_back(v);
    }
  }
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const auto a = static_cast<std::uint32_t>(y * (n + 1) + x);
      const auto row = static_cast<std::uint32_t>(n + 1);
      triangles.push_back({a, a + 1, a + row});
      triangles.push_back({a + 1, a + row + 1, a + row});
    }
  }
  return {std::move(vertices), std::move(triangles)};
}

TriangleMesh degenerate_triangles() {
  Random random(11);
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < 60; ++i) {
    const Vec3 a = random_point(random);
    const Vec3 b = random_point(random);
    const Vec3 c = random_point(random);
    const std::uint32_t first = 3 * i;
    switch (i % 6) {
      case 0:  // a point
        vertices.insert(vertices.end(), {a, a, a});
        break;
      case 1:  // two corners equal
        vertices.insert(vertices.end(), {a, b, b});
        break;
      case 2:  // three corners on a line, exactly
        vertices.insert(vertices.end(), {Vec3(0.25F, 0.5F, 0.5F), Vec3(0.5F), Vec3(0.75F, 0.5F, 0.5F)});
        break;
      case 3:  // a needle
        vertices.insert(vertices.end(), {a, b, a + 1e-7F * c});
        break;
      default:  // a good one
        vertices.insert(vertices.end(), {a, b, c});
    }
    triangles.push_back({first, first + 1, first + 2});
  }
  return {std::move(vertices), std::move(triangles)};
}

// Good triangles among ones with NaN, infinite and excessive coordinates, which must never be hit nor spoil a node.
TriangleMesh poisoned_triangles() {
  const TriangleMesh good = random_triangles(200, 0.2F, 12);
  std::vector<Vec3> vertices(good.vertices().begin(), good.vertices().end());
  for (std::size_t i = 0; i < vertices.size(); i += 21) vertices[i].x = kNan;
  for (std::size_t i = 4; i < vertices.size(); i += 33) vertices[i].y = kInfinity;
  for (std::size_t i = 8; i < vertices.size(); i += 45) vertices[i].z = -3e38F;
  return {std::move(vertices), {good.triangles().begin(), good.triangles().end()}};
}

TriangleMesh copies_of_one(std::size_t count) {
  std::vector<Vec3> vertices{{0.1F, 0.2F, 0.3F}, {0.9F, 0.3F, 0.4F}, {0.4F, 0.8F, 0.6F}};
  return {std::move(vertices), std::vector<Triangle>(count, Triangle(0, 1, 2))};
}

// Small triangles that all share their centroid, and so defeat every split.
TriangleMesh common_centroid(std::size_t count) {
  Random random(13);
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < count; ++i) {
    // Corners symmetric about the point, so that all boxes have the same centre exactly.
    const Vec3 offset(static_cast<float>(1 + random.next_u32(64)) / 128.0F, static_cast<float>(1 + random.next_u32(64)) / 128.0F,
                      static_cast<float>(1 + random.next_u32(64)) / 128.0F);
    vertices.push_back(Vec3(0.5F) - offset);
    vertices.push_back(Vec3(0.5F) + offset);
    vertices.push_back(Vec3(0.5F) + Vec3(offset.x, -offset.y, offset.z));
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return {std::move(vertices), std::move(triangles)};
}

TriangleMesh one_huge_among_small() {
  const TriangleMesh small = random_triangles(300, 0.02F, 14);
  std::vector<Vec3> vertices(small.vertices().begin(), small.vertices().end());
  std::vector<Triangle> triangles(small.triangles().begin(), small.triangles().end());
  const auto first = static_cast<std::uint32_t>(vertices.size());
  vertices.insert(vertices.end(), {Vec3(-1e4F, 0.4F, -1e4F), Vec3(1e4F, 0.5F, -1e4F), Vec3(0.0F, 0.6F, 2e4F)});
  triangles.push_back({first, first + 1, first + 2});
  return {std::move(vertices), std::move(triangles)};
}

// Corners on a coarse lattice: many shared planes, edges, vertices and duplicate triangles.
TriangleMesh lattice_triangles(std::size_t count) {
  Random random(15);
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (int z = 0; z < 4; ++z)
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x) vertices.push_back(Vec3(x, y, z) * 0.25F);
  for (std::size_t i = 0; i < count; ++i) triangles.push_back({random.next_u32(64), random.next_u32(64), random.next_u32(64)});
  return {std::move(vertices), std::move(triangles)};
}

SphereSet random_spheres(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<SphereSet::Sphere> spheres;
  for (std::size_t i = 0; i < count; ++i) spheres.push_back({random_point(random), random.next_float(0.01F, 0.12F)});
  return SphereSet(std::move(spheres));
}

SphereSet odd_spheres() {
  std::vector<SphereSet::Sphere> spheres;
  for (int i = 0; i < 40; ++i) spheres.push_back({Vec3(0.5F), 0.01F * static_cast<float>(i)});  // concentric; the first has no radius
  spheres.push_back({Vec3(0.25F), 0.1F});
  spheres.push_back({Vec3(0.25F), 0.1F});
  spheres.push_back({Vec3(kNan, 0.0F, 0.0F), 1.0F});
  spheres.push_back({Vec3(0.0F), kInfinity});
  spheres.push_back({Vec3(0.0F), -1.0F});
  spheres.push_back({Vec3(0.0F, -1e5F, 0.0F), 1e5F});  // a floor
  spheres.push_back({Vec3(0.75F), 1e-20F});
  return SphereSet(std::move(spheres));
}

// Axis-aligned solid boxes, as a program might bring its own primitive.
class SolidBoxes final : public UserGeometry {
 public:
  explicit SolidBoxes(std::vector<Box> boxes) : boxes_(std::move(boxes)) {}
  [[nodiscard]] std::size_t size() const override { return boxes_.size(); }
  [[nodiscard]] Box bounds(std::size_t i) const override { return boxes_[i]; }
  [[nodiscard]] bool intersect_primitive(std::size_t i, const Ray& ray, Hit& hit) const override {
    double near = -kInfinity;
    double far = kInfinity;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = static_cast<double>(boxes_[i].lower[axis]) - ray.origin[axis];
      const double high = static_cast<double>(boxes_[i].upper[axis]) - ray.origin[axis];
      if (ray.direction[axis] == 0.0F) {
        if (low > 0.0 || high < 0.0) return false;
        continue;
      }
      const double a = low / ray.direction[axis];
      const double b = high / ray.direction[axis];
      near = std::fmax(near, std::fmin(a, b));
      far = std::fmin(far, std::fmax(a, b));
    }
    if (!(near <= far)) return false;
    for (const double t : {near, far}) {
      const auto rounded = static_cast<float>(t);
      if (!(rounded >= ray.t_min && rounded >= 0.0F && rounded <= ray.t_max)) continue;
      hit.t = rounded;
      hit.u = static_cast<float>(t == near ? 0 : 1);
      hit.v = 0.5F;
      return true;
    }
    return false;
  }

 private:
  std::vector<Box> boxes_;
};

std::shared_ptr<const UserGeometry> random_boxes(std::size_t count) {
  Random random(17);
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 corner = random_point(random);
    boxes.push_back({corner, corner + 0.1F * random_point(random)});
  }
  boxes.push_back({Vec3(0.3F), Vec3(0.3F, 0.7F, 0.7F)});  // a box without thickness
  boxes.push_back({});                                    // never hit
  return std::make_shared<SolidBoxes>(std::move(boxes));
}

Mat4 random_affine(Random& random, float scale) {
  Mat4 matrix(1.0F);
  for (int column = 0; column < 3; ++column) matrix[column] = Vec4(scale * (2.0F * random_point(random) - Vec3(1.0F)), 0.0F);
  matrix[3] = Vec4(random_point(random), 1.0F);
  return matrix;
}

// Instances of a mesh and of spheres, some overlapping, some the same, one flat, one that is not finite.
std::shared_ptr<const InstanceSet> random_instances() {
  Random random(18);
  const std::shared_ptr<const Traceable> mesh = build(random_triangles(60, 0.4F, 19), "brute");
  const std::shared_ptr<const Traceable> spheres = build(std::make_shared<const SphereSet>(random_spheres(30, 20)), "brute");
  std::vector<InstanceSet::Instance> instances;
  for (int i = 0; i < 40; ++i) instances.push_back({i % 3 == 0 ? spheres : mesh, Transform(random_affine(random, 0.3F))});
  instances.push_back(instances[5]);
  instances.push_back({mesh, Transform()});
  Mat4 flat(1.0F);
  flat[2] = Vec4(0.0F);
  instances.push_back({mesh, Transform(flat)});
  Mat4 broken(1.0F);
  broken[3] = Vec4(kNan, 0.0F, 0.0F, 1.0F);
  instances.push_back({mesh, Transform(broken)});
  return std::make_shared<const InstanceSet>(std::move(instances));
}

// Two levels of instances: an instance's object is itself a top level.
std::shared_ptr<const InstanceSet> nested_instances() {
  Random random(21);
  const std::shared_ptr<const Traceable> inner = build(random_instances(), "brute");
  std::vector<InstanceSet::Instance> instances;
  for (int i = 0; i < 4; ++i) instances.push_back({inner, Transform(random_affine(random, 0.5F))});
  return std::make_shared<const InstanceSet>(std::move(instances));
}

}  // namespace

TriangleMesh random_triangles(std::size_t triangle_count, float size, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < triangle_count; ++i) {
    const Vec3 corner = random_point(random);
    vertices.push_back(corner);
    vertices.push_back(corner + size * (random_point(random) - Vec3(0.5F)));
    vertices.push_back(corner + size * (random_point(random) - Vec3(0.5F)));
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return {std::move(vertices), std::move(triangles)};
}

TriangleMesh closed_mesh(int level, float noise, std::uint64_t seed) {
  // An octahedron, each triangle split in four `level` times; midpoints are shared, so the mesh stays closed.
  std::vector<Vec3> vertices{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<Triangle> triangles{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int i = 0; i < level; ++i) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> midpoints;
    const auto midpoint = [&](std::uint32_t a, std::uint32_t b) {
      const auto [entry, is_new] = midpoints.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(vertices.size()));
      if (is_new) vertices.push_back(glm::normalize(vertices[a] + vertices[b]));
      return entry->second;
    };
    std::vector<Triangle> finer;
    for (const Triangle& t : triangles) {
      const std::uint32_t ab = midpoint(t.x, t.y);
      const std::uint32_t bc = midpoint(t.y, t.z);
      const std::uint32_t ca = midpoint(t.z, t.x);
      finer.insert(finer.end(), {{t.x, ab, ca}, {ab, t.y, bc}, {ca, bc, t.z}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  Random random(seed);
  for (Vec3& v : vertices) v *= 1.0F + noise * (random.next_float() - 0.5F);
  return {std::move(vertices), std::move(triangles)};
}

std::vector<NamedGeometry> matrix_geometries() {
  const auto mesh = [](TriangleMesh m) { return std::make_shared<const TriangleMesh>(std::move(m)); };
  TriangleMesh parts = random_triangles(50, 0.3F, 31);
  for (int i = 0; i < 3; ++i) {
    const TriangleMesh more = random_triangles(static_cast<std::size_t>(20 * i), 0.3F, 32 + static_cast<std::uint64_t>(i));
    parts.add_part({more.vertices().begin(), more.vertices().end()}, {more.triangles().begin(), more.triangles().end()});
  }
  return {
      {"no_triangles", mesh({})},
      {"one_triangle", mesh(random_triangles(1, 0.8F, 1))},
      {"two_triangles", mesh(random_triangles(2, 0.8F, 2))},
      {"random_triangles", mesh(random_triangles(1500, 0.2F, 3))},
      {"large_triangles", mesh(random_triangles(300, 1.5F, 4))},
      {"closed_mesh", mesh(closed_mesh(4, 0.1F, 5))},
      {"parts", mesh(std::move(parts))},
      {"flat_x", mesh(flat_grid(12, 0))},
      {"flat_y", mesh(flat_grid(12, 1))},
      {"flat_z", mesh(flat_grid(12, 2))},
      {"degenerate", mesh(degenerate_triangles())},
      {"not_finite", mesh(poisoned_triangles())},
      {"duplicates", mesh(copies_of_one(700))},
      {"common_centroid", mesh(common_centroid(500))},
      {"huge_among_small", mesh(one_huge_among_small())},
      {"lattice", mesh(lattice_triangles(400))},
      {"tiny_coordinates", mesh(scaled(random_triangles(200, 0.3F, 6), 1e-20F, Vec3(0.0F)))},
      {"denormal_coordinates", mesh(scaled(random_triangles(200, 0.3F, 6), 1e-40F, Vec3(0.0F)))},
      {"huge_coordinates", mesh(scaled(random_triangles(200, 0.3F, 7), 1e18F, Vec3(0.0F)))},
      {"largest_coordinates", mesh(scaled(random_triangles(200, 0.3F, 7), 3e37F, Vec3(0.0F)))},
      {"far_from_origin", mesh(scaled(random_triangles(400, 0.3F, 8), 1.0F, Vec3(1e6F, -1e6F, 1e6F)))},
      {"no_spheres", std::make_shared<const SphereSet>()},
      {"random_spheres", std::make_shared<const SphereSet>(random_spheres(600, 9))},
      {"odd_spheres", std::make_shared<const SphereSet>(odd_spheres())},
      {"user_boxes", random_boxes(300)},
      {"instances", random_instances()},
      {"nested_instances", nested_instances()},
  };
}

std::size_t size_of(const GeometryPointer& geometry) {
  return std::visit([](const auto& set) { return set->size(); }, geometry);
}

Box bounds_of(const GeometryPointer& geometry, std::size_t i) {
  return std::visit([&](const auto& set) { return set->bounds(i); }, geometry);
}

}  // namespace grove::test
