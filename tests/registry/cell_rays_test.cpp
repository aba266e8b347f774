// Rays that aim at the cells of a kd-tree or an octree: lying in its planes, along the edges and through the corners of its cells, from and to both sides. Hits must
// be those of brute force, bit for bit, also where primitives lie in the planes.

#include <gtest/gtest.h>

#include "grove/base/random.h"
#include "registry/matrix_geometry.h"
#include "registry/matrix_specs.h"

namespace grove::test {
namespace {

std::vector<Ray> cell_rays(const Accelerator& structure, std::size_t count, std::uint64_t seed) {
  std::vector<Box> cells;
  structure.visit_nodes([&](const NodeView& node) {
    if (node.is_leaf) cells.push_back(node.box);
  });
  Random random(seed);
  const Box bounds = structure.bounds();
  const Vec3 side = bounds.extent();
  const auto corner_of = [&](const Box& cell) {
    Vec3 corner;
    for (int axis = 0; axis < 3; ++axis) corner[axis] = random.next_u32(2) == 0 ? cell.lower[axis] : cell.upper[axis];
    return corner;
  };
  const auto anywhere = [&] {
    return bounds.lower - 0.5F * side + 2.0F * side * Vec3(random.next_float(), random.next_float(), random.next_float());
  };
  std::vector<Ray> rays;
  const auto add = [&](const Vec3& origin, const Vec3& direction, float t_max) { rays.push_back({origin, 0.0F, direction, t_max}); };
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < count && !cells.empty(); ++i) {
    const Box& cell = cells[random.next_u32(static_cast<std::uint32_t>(cells.size()))];
    const Box& other = cells[random.next_u32(static_cast<std::uint32_t>(cells.size()))];
    const Vec3 corner = corner_of(cell);
    const Vec3 from = anywhere();
    // Through a corner, ending at it, beginning at it, and from corner to corner.
    add(from, corner - from, kInfinity);
    add(from, corner - from, 1.0F);
    add(corner, from - corner, kInfinity);
    add(corner, corner_of(other) - corner, kInfinity);
    add(corner, corner_of(other) - corner, 1.0F);
    // Along an edge, and beside it by the last digit.
    const auto along = static_cast<int>(random.next_u32(3));
    Vec3 direction(0.0F);
    direction[along] = random.next_u32(2) == 0 ? -1.0F : 1.0F;
    Vec3 before = corner;
    before[along] -= direction[along] * (0.1F + 1.5F * side[along]);
    add(before, direction, kInfinity);
    for (int axis = 0; axis < 3; ++axis)
      if (axis != along) before[axis] = std::nextafter(before[axis], random.next_u32(2) == 0 ? -kInfinity : kInfinity);
    add(before, direction, kInfinity);
    // In a plane, and through a point of it.
    const auto across = static_cast<int>(random.next_u32(3));
    Vec3 in_plane = anywhere();
    in_plane[across] = corner[across];
    add(in_plane, corner - in_plane, kInfinity);
    // Across an edge.
    Vec3 on_edge = corner;
    on_edge[along] = cell.lower[along] + (cell.upper[along] - cell.lower[along]) * random.next_float();
    add(from, on_edge - from, kInfinity);
    add(on_edge, corner_of(other) - on_edge, kInfinity);
  }
  return rays;
}

class CellRays : public testing::TestWithParam<std::string> {};

TEST_P(CellRays, GiveHitsOfBruteForce) {
  for (const NamedGeometry& named : matrix_geometries()) {
    SCOPED_TRACE(named.name);
    const auto oracle = build(named.geometry, "brute");
    const auto structure = build(named.geometry, GetParam());
    std::size_t differences = 0;
    const std::vector<Ray> rays = cell_rays(*structure, 150, 46);
    for (const Ray& ray : rays) {
      const Hit expected = oracle->intersect(ray);
      if (!same_bits(structure->intersect(ray), expected) || structure->occluded(ray) != static_cast<bool>(expected)) ++differences;
    }
    EXPECT_EQ(differences, 0U) << "of " << rays.size() << " rays";
  }
}

INSTANTIATE_TEST_SUITE_P(KdTree, CellRays,
                         testing::Values("kdtree", "kdtree:walk=ropes", "kdtree:clip=false,walk=ropes,mailbox=false",
                                         "kdtree:split=binned,mailbox=false", "kdtree:split=object-median,walk=ropes",
                                         "kdtree:split=spatial-median,walk=ropes", "kdtree:split=spatial-median,clip=false"),
                         [](const auto& test) { return as_test_name(test.param); });

INSTANTIATE_TEST_SUITE_P(Octree, CellRays,
                         testing::Values("octree", "octree:mailbox=false,leaf-size=1", "octree:store=inner", "octree:walk=neighbour",
                                         "octree:walk=neighbour,leaf-size=1", "octree:store=inner,walk=neighbour", "octree-r",
                                         "octree-r:walk=neighbour", "octree-r:walk=neighbour,planes=events,leaf-size=1",
                                         "octree-r:planes=joint,walk=neighbour,mailbox=false"),
                         [](const auto& test) { return as_test_name(test.param); });

}  // namespace
}  // namespace grove::test
