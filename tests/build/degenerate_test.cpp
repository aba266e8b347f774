// Every builder at every arity, on sets that give a split nothing to go by. Hits are checked in tests/registry.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <ostream>
#include <string>

#include "build/sample_meshes.h"
#include "grove/build/bottom_up/lbvh.h"
#include "grove/build/bottom_up/ploc.h"
#include "grove/build/passes/collapse.h"
#include "grove/build/spatial_splits.h"
#include "grove/build/top_down.h"

namespace grove {
namespace {

constexpr std::uint32_t kCount = 200000;
constexpr std::uint32_t kLeafSize = 8;

using VertexOf = std::function<Vec3(std::uint32_t, int)>;

TriangleMesh make_mesh(const VertexOf& vertex_of) {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    for (int corner = 0; corner < 3; ++corner) vertices.push_back(vertex_of(i, corner));
    triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  return {std::move(vertices), std::move(triangles)};
}

// The corners of a triangle whose box is the cube from -size to size.
Vec3 around_origin(int corner, float size) {
  const Vec3 corners[] = {{-size, -size, -size}, {size, size, -size}, {-size, size, size}};
  return corners[corner];
}

TriangleMesh concentric() {
  return make_mesh([](std::uint32_t i, int corner) { return around_origin(corner, 1.0F + static_cast<float>(i % 5000)); });
}

TriangleMesh identical() {
  return make_mesh([](std::uint32_t /*i*/, int corner) { return around_origin(corner, 1.0F); });
}

TriangleMesh one_huge() {
  Random random(1);
  Vec3 centre(0.0F);
  return make_mesh([=](std::uint32_t i, int corner) mutable {
    if (i == kCount / 2) return around_origin(corner, 1000.0F);
    if (corner == 0) centre = testing::random_point(random);
    return centre + around_origin(corner, 0.5F);
  });
}

TriangleMesh not_finite() {
  Random random(2);
  Vec3 centre(0.0F);
  return make_mesh([=](std::uint32_t i, int corner) mutable {
    if (corner == 0) centre = testing::random_point(random);
    const Vec3 point = centre + around_origin(corner, 0.01F);
    const float bad = i % 6 == 0 ? std::numeric_limits<float>::quiet_NaN() : std::numeric_limits<float>::infinity();
    return i % 3 == 0 && corner == 1 ? Vec3(point.x, bad, point.z) : point;
  });
}

TriangleMesh points() {
  return make_mesh([](std::uint32_t i, int /*corner*/) { return Vec3(static_cast<float>(i % 7)); });
}

using Builder = Bvh2 (*)(const TriangleMesh&, std::uint32_t leaf_size);

template <ObjectSplit kSplit>
Bvh2 build_with(const TriangleMesh& mesh, std::uint32_t leaf_size) {
  return build_top_down(list_references(mesh), {.split = kSplit, .leaf_size = leaf_size});
}
Bvh2 build_spatial(const TriangleMesh& mesh, std::uint32_t leaf_size) {
  return build_with_spatial_splits(mesh, {.leaf_size = leaf_size});
}
Bvh2 build_by_code(const TriangleMesh& mesh, std::uint32_t leaf_size) {
  return build_lbvh(list_references(mesh), {.leaf_size = leaf_size});
}
Bvh2 build_by_clusters(const TriangleMesh& mesh, std::uint32_t leaf_size) {
  return build_ploc(list_references(mesh), {.leaf_size = leaf_size});
}

struct NamedBuilder {
  std::string name;
  Builder build;
  friend void PrintTo(const NamedBuilder& builder, std::ostream* out) { *out << builder.name; }
};

struct NamedMesh {
  std::string name;
  TriangleMesh (*make)();
  friend void PrintTo(const NamedMesh& mesh, std::ostream* out) { *out << mesh.name; }
};

class Degenerate : public ::testing::TestWithParam<std::tuple<NamedBuilder, NamedMesh>> {};

template <typename Hierarchy>
void expect_whole(const Hierarchy& hierarchy, const TriangleMesh& mesh, const char* arity) {
  SCOPED_TRACE(arity);
  EXPECT_EQ(hierarchy.validate(mesh.size()), "");  // depth is in it
  std::vector<bool> referenced(mesh.size(), false);
  for (const std::uint32_t id : hierarchy.references) referenced[id] = true;
  std::size_t hittable = 0;
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const bool can_be_hit = !mesh.bounds(i).is_empty();
    hittable += can_be_hit ? 1 : 0;
    wrong += referenced[i] != can_be_hit ? 1 : 0;
  }
  EXPECT_EQ(wrong, 0U) << "are left out, or in for nothing";
  EXPECT_LE(hierarchy.references.size(), 2 * hittable);
  std::uint32_t largest = 0;
  hierarchy.visit([&](const Box&, std::uint32_t, std::uint32_t, std::uint32_t count) { largest = std::max(largest, count); });
  EXPECT_LE(largest, kLeafSize);
}

TEST_P(Degenerate, IsBuiltWholeAndWithinBounds) {
  const auto& [builder, set] = GetParam();
  const TriangleMesh mesh = set.make();
  expect_whole(builder.build(mesh, kLeafSize), mesh, "binary");
  const Bvh2 single = builder.build(mesh, 1);
  const CollapseSettings settings{.leaf_size = kLeafSize};
  expect_whole(collapse_leaves(single, settings), mesh, "binary, leaves decided later");
  expect_whole(widen<4>(single, settings), mesh, "four wide");
  expect_whole(widen<8>(single, settings), mesh, "eight wide");
}

INSTANTIATE_TEST_SUITE_P(Builders, Degenerate,
                         ::testing::Combine(::testing::Values(NamedBuilder{"binned", build_with<ObjectSplit::binned>},
                                                              NamedBuilder{"sweep", build_with<ObjectSplit::sweep>},
                                                              NamedBuilder{"object_median", build_with<ObjectSplit::object_median>},
                                                              NamedBuilder{"spatial_median", build_with<ObjectSplit::spatial_median>},
                                                              NamedBuilder{"spatial", build_spatial}, NamedBuilder{"lbvh", build_by_code},
                                                              NamedBuilder{"ploc", build_by_clusters}),
                                            ::testing::Values(NamedMesh{"concentric", concentric}, NamedMesh{"identical", identical},
                                                              NamedMesh{"one_huge", one_huge}, NamedMesh{"not_finite", not_finite},
                                                              NamedMesh{"points", points})),
                         [](const auto& test) { return std::get<0>(test.param).name + "_" + std::get<1>(test.param).name; });

}  // namespace
}  // namespace grove
