#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "grove/base/random.h"
#include "grove/render/sampling/warp.h"
#include "grove/render/scene_accelerator.h"
#include "grove/render/surface/frame.h"
#include "grove/render/surface/perturb_normal.h"
#include "grove/render/surface/surface_table.h"
#include "test_scenes.h"

namespace grove {
namespace {

using testing::SceneMaker;

constexpr std::uint64_t kSeed = 90210;

Vec3 random_direction(Random& random) {
  return sample_sphere({random.next_float(), random.next_float()});
}

TEST(Frame, IsOrthonormalForAllDirections) {
  Random random(kSeed);
  for (int i = 0; i < 2000; ++i) {
    Vec3 n = random_direction(random);
    if (i == 0) n = {0, 0, -1};
    if (i == 1) n = {0, 0, 1};
    const Frame frame(n);
    EXPECT_NEAR(glm::length(frame.x), 1.0F, 1e-5F);
    EXPECT_NEAR(glm::dot(frame.x, frame.y), 0.0F, 1e-5F);
    EXPECT_NEAR(glm::length(glm::cross(frame.x, frame.y) - n), 0.0F, 1e-5F) << "seed " << kSeed << ", direction " << i;
  }
}

// One triangle, its outer side towards +z by the winding.
Scene triangle_scene(bool flip, const std::vector<Vec3>& normals, const Mat4& transform) {
  Scene scene;
  scene.materials.push_back(SceneMaker::diffuse(Vec3(0.5F)));
  Object object;
  object.geometry = std::make_shared<TriangleMesh>(std::vector<Vec3>{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, std::vector<Triangle>{{0, 1, 2}});
  Part& part = object.parts.emplace_back();
  part.flip_orientation = flip;
  part.normals = normals;
  part.uvs = {{0.0F, 1.0F}, {1.0F, 1.0F}, {0.0F, 0.0F}};
  part.colours = {Vec4(1, 0, 0, 1), Vec4(0, 1, 0, 1), Vec4(0, 0, 1, 0)};
  scene.objects.push_back(object);
  scene.instances.push_back({"", 0, Transform(transform)});
  scene.validate("triangle");
  return scene;
}

TEST(SurfaceTable, OuterSideFollowsWindingFlipAndVertexNormals) {
  const Vec2 middle(0.25F, 0.5F);
  const Mat4 identity(1.0F);
  const auto normal_of = [&](const Scene& scene) { return SurfaceTable(scene).on_triangle(0, 0, 0, middle); };
  EXPECT_EQ(normal_of(triangle_scene(false, {}, identity)).geometric_normal, Vec3(0, 0, 1));
  EXPECT_EQ(normal_of(triangle_scene(true, {}, identity)).geometric_normal, Vec3(0, 0, -1));
  const std::vector<Vec3> down(3, glm::normalize(Vec3(0.3F, 0.0F, -1.0F)));
  const SurfacePoint against = normal_of(triangle_scene(false, down, identity));
  EXPECT_EQ(against.geometric_normal, Vec3(0, 0, -1));
  EXPECT_NEAR(glm::length(against.shading_normal - down[0]), 0.0F, 1e-6F);
  // A mirroring transform keeps the outer side, as glTF wants: here z is kept and x mirrored.
  const Mat4 mirror(Vec4(-1, 0, 0, 0), Vec4(0, 1, 0, 0), Vec4(0, 0, 1, 0), Vec4(5, 0, 0, 1));
  EXPECT_EQ(normal_of(triangle_scene(false, {}, mirror)).geometric_normal, Vec3(0, 0, 1));
}

TEST(SurfaceTable, InterpolatesAttributesInWorldSpace) {
  const Mat4 scale(Vec4(3, 0, 0, 0), Vec4(0, 1, 0, 0), Vec4(0, 0, 1, 0), Vec4(0, 0, 7, 1));
  const Scene scene = triangle_scene(false, {}, scale);
  const SurfacePoint point = SurfaceTable(scene).on_triangle(0, 0, 0, {0.25F, 0.5F});
  EXPECT_NEAR(glm::length(point.position - Vec3(1.5F, 1.0F, 7.0F)), 0.0F, 1e-5F);
  EXPECT_NEAR(glm::length(point.uv - Vec2(0.25F, 0.5F)), 0.0F, 1e-6F);
  EXPECT_NEAR(glm::length(point.colour - Vec4(0.25F, 0.25F, 0.5F, 0.5F)), 0.0F, 1e-6F);
  EXPECT_NEAR(glm::length(point.dp_du - Vec3(6, 0, 0)), 0.0F, 1e-5F);
  EXPECT_NEAR(glm::length(point.dp_dv - Vec3(0, -2, 0)), 0.0F, 1e-5F);
}

TEST(SurfaceTable, CoordinatesAreThoseOfThePoint) {
  const auto expect_same = [](const Scene& scene, const Hit& hit) {
    const Ray ray{{0, 0, 5}, 0.0F, {0, 0, -1}};
    const SurfaceTable table(scene);
    const SurfaceCoordinates expected = table.at(ray, hit).surface_coordinates();
    const SurfaceCoordinates found = table.coordinates_at(hit);
    EXPECT_EQ(found.texture.sets, expected.texture.sets);
    EXPECT_EQ(found.colour_alpha, expected.colour_alpha);
  };
  const Hit on_triangle{.t = 5.0F, .u = 0.3F, .v = 0.6F, .primitive = 0, .geometry = 0};
  Scene scene = triangle_scene(false, {}, Mat4(1.0F));
  expect_same(scene, on_triangle);
  Part& part = scene.objects[0].parts[0];
  part.second_uvs = {{0.5F, 0.1F}, {0.7F, 0.9F}, {0.2F, 0.3F}};
  expect_same(scene, on_triangle);
  part.uvs.clear();
  expect_same(scene, on_triangle);
  part.second_uvs.clear();
  part.colours.clear();
  expect_same(scene, on_triangle);
  SceneMaker maker;
  maker.sphere({{0.0F, 0.0F, 0.0F}, 1.0F}, maker.material(SceneMaker::diffuse(Vec3(0.5F))));
  expect_same(maker.make(), {.t = 4.0F, .u = 0.3F, .v = 0.6F, .primitive = 0, .geometry = 0});
}

TEST(SurfaceTable, SphereHitsLieOnTheSphere) {
  SceneMaker maker;
  const Mat4 squash(Vec4(2, 0, 0, 0), Vec4(0, 0.5F, 0, 0), Vec4(0, 0.3F, 1, 0), Vec4(10, -3, 4, 1));
  maker.sphere({{1, 2, 3}, 0.5F}, maker.material(SceneMaker::diffuse(Vec3(0.5F))), squash);
  const Scene scene = maker.make();
  const SceneAccelerator accelerator(scene, "bvh");
  const SurfaceTable surfaces(scene);
  const Transform transform(squash);
  Random random(kSeed);
  int hits = 0;
  for (int i = 0; i < 200; ++i) {
    Ray ray;
    ray.direction = random_direction(random);
    ray.origin = transform.point({1, 2, 3}) - 20.0F * ray.direction + 0.1F * random_direction(random);
    const Hit hit = accelerator.top().intersect(ray);
    if (!hit) continue;
    ++hits;
    const SurfacePoint point = surfaces.at(ray, hit);
    EXPECT_NEAR(glm::length(point.position - ray.at(hit.t)), 0.0F, 1e-4F) << "seed " << kSeed << ", ray " << i;
    const Vec3 local = transform.inverse_point(point.position) - Vec3(1, 2, 3);
    EXPECT_NEAR(glm::length(local), 0.5F, 1e-5F);
    // Outward, and at right angles to the tangents.
    EXPECT_LT(glm::dot(point.geometric_normal, ray.direction), 0.0F);
    EXPECT_NEAR(glm::dot(point.geometric_normal, glm::normalize(point.dp_du)), 0.0F, 1e-4F);
    EXPECT_NEAR(glm::dot(point.geometric_normal, glm::normalize(point.dp_dv)), 0.0F, 1e-4F);
    EXPECT_EQ(point.uv, Vec2(hit.u, hit.v));
  }
  EXPECT_GT(hits, 150);
}

struct OffsetCase {
  const char* name;
  float size;         // of triangles
  float distance;     // from the origin of object space
  float translation;  // of the instance
};

class RayOffset : public ::testing::TestWithParam<OffsetCase> {};

INSTANTIATE_TEST_SUITE_P(Scales, RayOffset,
                         ::testing::Values(OffsetCase{"plain", 1.0F, 1.0F, 0.0F}, OffsetCase{"far", 1.0F, 1e4F, 0.0F},
                                           OffsetCase{"tiny", 1e-12F, 1e-12F, 0.0F}, OffsetCase{"huge", 1e12F, 1e12F, 0.0F},
                                           OffsetCase{"moved_back", 1.0F, 3000.0F, -3000.0F}, OffsetCase{"moved_away", 1.0F, 0.0F, 5000.0F},
                                           OffsetCase{"scaled", 0.01F, 0.5F, 200.0F}),
                         [](const auto& which) { return std::string(which.param.name); });

// A ray that leaves a flat surface does not meet it again, on either side; and the step away from it is small.
TEST_P(RayOffset, LeavesTheSurfaceBehind) {
  const OffsetCase& which = GetParam();
  Random random(kSeed);
  int met = 0;
  for (int i = 0; i < 400; ++i) {
    Scene scene;
    scene.materials.push_back(SceneMaker::diffuse(Vec3(0.5F)));
    const Vec3 centre = which.distance * random_direction(random);
    std::vector<Vec3> corners;
    for (int c = 0; c < 3; ++c) corners.push_back(centre + which.size * random_direction(random));
    Object object;
    object.geometry = std::make_shared<TriangleMesh>(corners, std::vector<Triangle>{{0, 1, 2}});
    object.parts.emplace_back();
    scene.objects.push_back(object);
    Mat4 matrix(1.0F);
    if (which.translation != 0.0F) {
      const Frame frame(random_direction(random));
      const Vec3 moved = which.translation < 0.0F ? -(frame.x * centre.x + frame.y * centre.y + frame.z * centre.z)
                                                  : which.translation * random_direction(random);
      matrix = Mat4(Vec4(frame.x, 0), Vec4(frame.y, 0), Vec4(frame.z, 0), Vec4(moved, 1));
    }
    scene.instances.push_back({"", 0, Transform(matrix)});
    const SceneAccelerator accelerator(scene, "brute");
    const SurfaceTable surfaces(scene);
    const SurfacePoint point = surfaces.on_triangle(0, 0, 0, sample_triangle({random.next_float(), random.next_float()}));
    EXPECT_LT(point.error, 1e-4F * std::max({which.size, which.distance, std::fabs(which.translation)}));
    for (int k = 0; k < 20; ++k) {
      Ray ray;
      ray.direction = random_direction(random);
      ray.origin = point.offset_origin(ray.direction);
      if (accelerator.top().intersect(ray)) ++met;
    }
  }
  EXPECT_EQ(met, 0) << "seed " << kSeed;
}

TEST(RayOffset, LeavesSpheresBehind) {
  Random random(kSeed);
  for (const float distance : {0.0F, 3.0F, 1e4F}) {
    SceneMaker maker;
    const Vec3 centre = distance * random_direction(random);
    maker.sphere({centre, 0.7F}, maker.material(SceneMaker::diffuse(Vec3(0.5F))));
    const Scene scene = maker.make();
    const SceneAccelerator accelerator(scene, "bvh");
    const SurfaceTable surfaces(scene);
    for (int i = 0; i < 2000; ++i) {
      const SurfacePoint point = surfaces.on_sphere(0, 0, 0, random_direction(random));
      Ray ray;
      ray.direction = random_direction(random);
      if (glm::dot(ray.direction, point.geometric_normal) < 0.0F) ray.direction = -ray.direction;
      ray.origin = point.offset_origin(ray.direction);
      ASSERT_FALSE(accelerator.top().intersect(ray)) << "seed " << kSeed << ", distance " << distance << ", ray " << i;
    }
  }
}

// A normal map that leans to the right and up of the picture leans the normal along the picture's right and up on the surface.
TEST(PerturbedNormal, FollowsThePictureWhateverTheTextureCoordinates) {
  auto image = std::make_shared<Image>();
  image->width = image->height = 1;
  image->channels = 3;
  image->bytes = {191, 153, 242};  // about (0.5, 0.2, 0.9)
  for (const bool is_v_up : {false, true}) {
    for (const bool is_mirrored : {false, true}) {
      Scene scene = triangle_scene(false, {}, Mat4(1.0F));
      scene.images.push_back(image);
      Texture texture;
      texture.kind = TextureKind::image;
      texture.image = 0;
      // Picture coordinates on the triangle: right along +x (or -x when mirrored), down along -y.
      for (Vec2& uv : scene.objects[0].parts[0].uvs) {
        if (is_mirrored) uv.x = 1.0F - uv.x;
        if (is_v_up) uv.y = 1.0F - uv.y;
      }
      if (is_v_up) texture.uv_transform = Mat3(Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0, 1, 1));
      scene.textures.push_back(texture);
      scene.materials[0].normal_texture = 0;
      const SurfacePoint point = SurfaceTable(scene).on_triangle(0, 0, 0, {0.2F, 0.2F});
      const Vec3 normal = perturbed_normal(scene, scene.materials[0], point);
      EXPECT_NEAR(normal.x / normal.z, (is_mirrored ? -1.0F : 1.0F) * 0.55F, 0.03F) << is_v_up << is_mirrored;
      EXPECT_NEAR(normal.y / normal.z, 0.22F, 0.03F) << is_v_up << is_mirrored;
    }
  }
}

// A height that grows along u tilts the normal back along u, by its slope in world units.
TEST(PerturbedNormal, BumpsTiltAgainstTheSlope) {
  auto image = std::make_shared<Image>();
  image->width = 2;
  image->height = 1;
  image->channels = 1;
  image->floats = {0.0F, 1.0F};
  Scene scene = triangle_scene(false, {}, Mat4(1.0F));
  scene.images.push_back(image);
  Texture texture;
  texture.kind = TextureKind::image;
  texture.image = 0;
  scene.textures.push_back(texture);
  scene.materials[0].bump = {.value = 0.5F, .texture = 0};
  // Between the texel centres the height rises by 0.5 over half of u, which is 1 unit long.
  const SurfacePoint point = SurfaceTable(scene).on_triangle(0, 0, 0, {0.5F, 0.25F});
  const Vec3 normal = perturbed_normal(scene, scene.materials[0], point);
  EXPECT_NEAR(normal.x / normal.z, -0.5F, 0.01F);
  EXPECT_NEAR(normal.y, 0.0F, 1e-4F);
}

}  // namespace
}  // namespace grove
