#include "grove/registry/choose_structure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "grove/base/error.h"
#include "grove/base/random.h"

namespace grove {
namespace {

using ::testing::HasSubstr;

/// `count` triangles of three random corners each within `spread` of a random place.
TriangleMesh random_mesh(std::size_t count, float spread) {
  Random random(3);
  const auto place = [&](float side) {
    const float x = random.next_float();
    const float y = random.next_float();
    return side * Vec3(x, y, random.next_float());
  };
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 at = place(1.0F);
    for (int corner = 0; corner < 3; ++corner) vertices.push_back(at + place(spread));
    triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  return {std::move(vertices), std::move(triangles)};
}

GeometrySample triangles(std::size_t size, double boxes_per_hit) {
  return {GeometryKind::triangles, size, boxes_per_hit, 1.0};
}

std::string chosen(const GeometrySample& sample, std::string_view spec) {
  return choose_structure(sample, use_of(spec)).structure;
}

TEST(GeometrySample, TellsHowBoxesFit) {
  // One sphere in its box: a line through the box meets it unless it passes by a corner.
  const auto sphere = std::make_shared<const SphereSet>(std::vector<SphereSet::Sphere>{{Vec3(1.0F, 2.0F, 3.0F), 0.5F}});
  const GeometrySample sample = sample_geometry(sphere);
  EXPECT_EQ(sample.kind, GeometryKind::spheres);
  EXPECT_EQ(sample.size, 1U);
  EXPECT_NEAR(sample.boxes_per_line, 1.0, 1e-9) << "every line goes through the box";
  EXPECT_GT(sample.boxes_per_hit(), 1.0);
  EXPECT_LT(sample.boxes_per_hit(), 2.0);
}

TEST(GeometrySample, IsScaledToAllPrimitivesAndTheSameEachTime) {
  const auto mesh = std::make_shared<const TriangleMesh>(random_mesh(20'000, 0.2F));
  const GeometrySample all = sample_geometry(std::make_shared<const TriangleMesh>(random_mesh(2'000, 0.2F)));
  const GeometrySample some = sample_geometry(mesh);
  EXPECT_EQ(some.size, 20'000U);
  EXPECT_NEAR(some.boxes_per_line / all.boxes_per_line, 10.0, 1.0);
  EXPECT_EQ(some.hits_per_line, sample_geometry(mesh).hits_per_line);
}

TEST(GeometrySample, OfNothingHittableIsNothing) {
  const GeometrySample sample = sample_geometry(std::make_shared<const TriangleMesh>());
  EXPECT_EQ(sample.size, 0U);
  EXPECT_EQ(sample.boxes_per_hit(), 1.0);
  EXPECT_EQ(choose_structure(sample, {}).structure.substr(0, 4), "fast");
}

TEST(ChooseStructure, BuildsTheBetterTheMoreRaysThereAre) {
  const GeometrySample sample = triangles(1'000'000, 4.0);
  EXPECT_EQ(chosen(sample, "auto:rays=1"), "fast:quality=low");
  EXPECT_EQ(chosen(sample, "auto"), "fast");
  EXPECT_EQ(chosen(sample, "auto:rays=10000"), "fast:quality=high");
}

TEST(ChooseStructure, CutsPrimitivesSoonerWhereBoxesFitBadly) {
  EXPECT_EQ(chosen(triangles(1'000'000, 4.0), "auto:rays=200"), "fast");
  EXPECT_EQ(chosen(triangles(1'000'000, 200.0), "auto:rays=200"), "fast:quality=high");
}

TEST(ChooseStructure, RefitsWhereMuchMovesAndFewRaysFollow) {
  EXPECT_EQ(chosen(triangles(10'000, 4.0), "auto:use=moving"), "fast:quality=low");
  EXPECT_EQ(chosen(triangles(10'000'000, 4.0), "auto:use=moving"), "bvh:arity=8");
}

TEST(ChooseStructure, OtherPrimitivesHaveAPriceListOfTheirOwn) {
  GeometrySample sample = triangles(1000, 1.8);
  sample.kind = GeometryKind::spheres;
  EXPECT_EQ(chosen(sample, "auto"), "bvh:arity=8,optimize=reinsertion");
  EXPECT_EQ(chosen(sample, "auto:use=moving"), "bvh:arity=8");
}

TEST(ChooseStructure, SaysWhyInOneLineWithFigures) {
  for (const char* const spec : {"auto", "auto:use=moving", "auto:use=memory"}) {
    const StructureChoice choice = choose_structure(triangles(123'456, 4.0), use_of(spec));
    EXPECT_THAT(choice.reason, ::testing::ContainsRegex("[0-9]")) << spec;
    EXPECT_THAT(choice.reason, ::testing::Not(HasSubstr("\n"))) << spec;
    EXPECT_EQ(canonical_spec(choice.structure), choice.structure);
  }
  EXPECT_THAT(choose_structure(triangles(123'456, 4.0), {}).reason, HasSubstr("123 k triangles"));
}

TEST(ChooseStructure, IsWhatAutoBuilds) {
  const auto mesh = std::make_shared<const TriangleMesh>(random_mesh(300, 0.1F));
  const auto structure = build(GeometryPointer(mesh), "auto");
  EXPECT_EQ(structure->spec(), choose_structure(GeometryPointer(mesh), use_of("auto")).structure);
  EXPECT_THROW(static_cast<void>(use_of("auto:use=toy")), UsageError);
}

}  // namespace
}  // namespace grove
