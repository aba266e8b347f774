// Frames of a scene that moves: the pictures are those of the scene at their time, and structures follow without more work than the motion needs.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "grove/base/error.h"
#include "grove/render/sequence/frame_renderer.h"
#include "grove/render/sequence/viewpoint.h"
#include "render/same_bits.h"
#include "render/test_scenes.h"

namespace grove::testing {
namespace {

using ::testing::IsEmpty;

constexpr std::uint32_t kGrid = 12;

// A lit floor that bulges by a morph target (object 0), and a small quad (object 1) that flies over it from 1 s on.
enum class Lit : std::uint8_t {
  by_sky,
  by_what_moves  ///< the quad shines, and a point light flies with it
};

AnimatedScene moving_scene(Lit lit = Lit::by_sky) {
  Scene scene;
  scene.materials.push_back(SceneMaker::diffuse(Vec3(0.7F)));
  if (lit == Lit::by_sky) {
    scene.environment.radiance = Vec3(1.0F);
  } else {
    scene.materials.push_back(SceneMaker::lamp(Vec3(20.0F), true));
    scene.lights.emplace_back().intensity = Vec3(0.1F);
  }
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  MorphTarget bulge;
  for (std::uint32_t z = 0; z <= kGrid; ++z) {
    for (std::uint32_t x = 0; x <= kGrid; ++x) {
      vertices.emplace_back(static_cast<float>(x) / kGrid - 0.5F, 0.0F, static_cast<float>(z) / kGrid - 0.5F);
      bulge.positions.emplace_back(0.0F, static_cast<float>(x * (kGrid - x) * z * (kGrid - z)) / 1e3F, 0.0F);
      const std::uint32_t v = z * (kGrid + 1) + x;
      if (x < kGrid && z < kGrid) triangles.insert(triangles.end(), {{v, v + kGrid + 1, v + 1}, {v + 1, v + kGrid + 1, v + kGrid + 2}});
    }
  }
  const auto add = [&](const std::vector<Vec3>& points, const std::vector<Triangle>& faces) {
    Object object;
    object.geometry = std::make_shared<TriangleMesh>(points, faces);
    object.parts.emplace_back();
    scene.instances.push_back({"", static_cast<std::uint32_t>(scene.objects.size()), Transform()});
    scene.objects.push_back(std::move(object));
  };
  add(vertices, triangles);
  add({{-0.1F, 0, -0.1F}, {-0.1F, 0, 0.1F}, {0.1F, 0, 0.1F}, {0.1F, 0, -0.1F}}, {{0, 1, 2}, {0, 2, 3}});
  if (lit == Lit::by_what_moves) scene.objects[1].parts[0].material = 1;
  scene.cameras.push_back(look_at({0, 2, 1.5F}, {0, 0, 0}, {0, 1, 0}, 0.6F));
  scene.validate("test scene");

  SceneAnimation animation;
  animation.end = 3.0;
  animation.nodes.parent = {NodeTree::kNoParent, NodeTree::kNoParent};
  animation.nodes.order = {0, 1};
  animation.nodes.rest.resize(2);
  animation.channels.push_back({0, ChannelTarget::weights, {Interpolation::linear, false, 1, {2, 3}, {0, 1}}});
  animation.channels.push_back(
      {1, ChannelTarget::translation, {Interpolation::linear, false, 3, {1, 3}, {-0.3F, 0.3F, 0, 0.3F, 0.3F, 0.2F}}});
  animation.instances = {{1, 1, Mat4(1.0F)}};
  if (lit == Lit::by_what_moves) animation.lights = {{0, 1, Mat4(1.0F)}};
  DeformableSurface surface;
  surface.vertices = vertices;
  surface.triangles = triangles;
  surface.targets = {bulge};
  animation.objects.push_back({0, 0, std::nullopt, {0.0F}, {surface}});
  return {std::move(scene), std::move(animation)};
}

Film picture_at(double time, const RenderSettings& settings, Lit lit = Lit::by_sky) {
  AnimatedScene scene = moving_scene(lit);
  scene.move_to(time);
  const SceneAccelerator accelerator(scene.scene(), "bvh");
  return render(scene.scene(), accelerator, settings).film;
}

TEST(FrameRenderer, FramesAreThePicturesOfTheirTimes) {
  const RenderSettings settings = small_settings(24, 2, 3);
  const double times[] = {0.0, 1.5, 2.2, 3.0, 0.5};
  std::vector<Film> expected;
  expected.reserve(std::size(times));
  for (const double time : times) expected.push_back(picture_at(time, settings));
  for (const auto& [spec, policy] : {std::pair("bvh", UpdatePolicy::automatic), std::pair("bvh", UpdatePolicy::refit),
                                     std::pair("bvh:arity=8", UpdatePolicy::rotate), std::pair("fast", UpdatePolicy::automatic),
                                     std::pair("kdtree", UpdatePolicy::automatic), std::pair("octree", UpdatePolicy::rebuild)}) {
    AnimatedScene scene = moving_scene();
    FrameRenderer renderer(scene, spec, policy);
    for (std::size_t i = 0; i < std::size(times); ++i) {
      const RenderedFrame frame = renderer.render(settings, {times[i]});
      EXPECT_TRUE(same_bits(frame.picture.film, expected[i])) << spec << " at " << times[i];
    }
  }
}

TEST(FrameRenderer, LightsFollowWhatMoves) {
  RenderSettings settings = small_settings(12, 2, 2);
  const double times[] = {0.0, 0.5, 1.5, 2.5, 3.0};
  AnimatedScene scene = moving_scene(Lit::by_what_moves);
  FrameRenderer renderer(scene, "bvh", UpdatePolicy::automatic);
  for (const LightSampling lights : {LightSampling::hierarchy, LightSampling::groups, LightSampling::power}) {
    settings.lights = lights;
    for (const double time : times) {
      EXPECT_TRUE(same_bits(renderer.render(settings, {time}).picture.film, picture_at(time, settings, Lit::by_what_moves))) << time;
    }
  }
}

TEST(FrameRenderer, NoMoreIsUpdatedThanMoved) {
  const RenderSettings settings = small_settings(8, 1, 1);
  AnimatedScene scene = moving_scene();
  FrameRenderer renderer(scene, "bvh", UpdatePolicy::refit);
  EXPECT_TRUE(renderer.render(settings, {0.0}).is_built);

  const RenderedFrame still = renderer.render(settings, {0.5});
  EXPECT_FALSE(still.is_built);
  EXPECT_THAT(still.update.objects, IsEmpty());
  EXPECT_FALSE(still.update.top);
  EXPECT_EQ(still.update.cost_growth, 1.0);

  const RenderedFrame flight = renderer.render(settings, {1.5});
  EXPECT_THAT(flight.update.objects, IsEmpty());
  ASSERT_TRUE(flight.update.top);
  EXPECT_EQ(flight.update.top->method, UpdateMethod::refit);
  EXPECT_EQ(flight.moved_instances, 1U);

  const RenderedFrame bulge = renderer.render(settings, {2.5});
  ASSERT_EQ(bulge.update.objects.size(), 1U);
  EXPECT_EQ(bulge.update.objects[0].method, UpdateMethod::refit);
  EXPECT_GT(bulge.update.cost_growth, 1.0) << "a bulge has larger boxes than a flat floor";
}

TEST(FrameRenderer, RebuildingUndoesTheGrowth) {
  const RenderSettings settings = small_settings(8, 1, 1);
  AnimatedScene scene = moving_scene();
  FrameRenderer renderer(scene, "bvh", UpdatePolicy::rebuild);
  (void)renderer.render(settings, {0.0});
  const RenderedFrame frame = renderer.render(settings, {2.5});
  EXPECT_EQ(frame.update.objects.at(0).method, UpdateMethod::rebuild);
  EXPECT_EQ(frame.update.cost_growth, 1.0);
}

TEST(FrameRenderer, BlurIsTheSumOverTimes) {
  RenderSettings settings = small_settings(24, 4, 3);
  AnimatedScene scene = moving_scene();
  FrameRenderer renderer(scene, "bvh", UpdatePolicy::automatic);
  const RenderedFrame blurred = renderer.render(settings, {1.0, 2.0, 4});
  EXPECT_EQ(blurred.moved_instances, 3U);
  EXPECT_TRUE(blurred.picture.part.is_whole(4));
  // Sample k is that of the k-th quarter's middle.
  Film expected(24, 24);
  for (std::uint32_t k = 0; k < 4; ++k) {
    settings.part = {0, 1, k, k + 1};
    const Film one = picture_at(1.25 + 0.5 * k, settings);
    for (std::uint32_t y = 0; y < 24; ++y)
      for (std::uint32_t x = 0; x < 24; ++x) expected.add(x, y, one.pixel(x, y));
  }
  EXPECT_TRUE(same_bits(blurred.picture.film, expected));
}

TEST(FrameRenderer, WhatDoesNotMoveIsNotBlurred) {
  const RenderSettings settings = small_settings(16, 6, 3);
  AnimatedScene scene = moving_scene();
  FrameRenderer renderer(scene, "bvh", UpdatePolicy::automatic);
  const RenderedFrame sharp = renderer.render(settings, {0.0});
  EXPECT_TRUE(same_bits(renderer.render(settings, {0.0, 0.9, 4}).picture.film, sharp.picture.film));
  EXPECT_THROW((void)renderer.render(settings, {0.0, 0.9, 7}), UsageError);
}

TEST(FrameRenderer, CamerasMayMoveAlone) {
  const RenderSettings settings = small_settings(16, 2, 2);
  AnimatedScene scene = moving_scene();
  FrameRenderer renderer(scene, "bvh", UpdatePolicy::automatic);
  const auto view = [](double time) { return look_at({time, 2, 1}, {0, 0, 0}, {0, 1, 0}, 0.6F); };
  const RenderedFrame first = renderer.render(settings, {0.0}, {}, view);
  const RenderedFrame second = renderer.render(settings, {0.5}, {}, view);
  EXPECT_FALSE(same_bits(first.picture.film, second.picture.film));
  EXPECT_FALSE(second.is_built);
  EXPECT_THAT(second.update.objects, IsEmpty());
}

Vec3 eye_of(const Camera& camera) {
  return Vec3(camera.camera_to_world[3]);
}

TEST(Viewpoint, TurnsRoundTheTarget) {
  Viewpoint viewpoint;
  viewpoint.eye = Vec3(1, 2, 5);
  viewpoint.target = Vec3(1, 0, 0);
  viewpoint.field_of_view = 1.0F;
  const Box bounds{Vec3(-9), Vec3(9)};
  EXPECT_EQ(eye_of(camera_at(viewpoint, bounds, 1.0F)), Vec3(1, 2, 5));
  const Camera quarter = camera_at(viewpoint, bounds, 1.0F, 0.25);
  EXPECT_NEAR(glm::length(eye_of(quarter) - Vec3(6, 2, 0)), 0.0F, 1e-5F);
  EXPECT_NEAR(quarter.field_of_view, 1.0F, 1e-7F);
  // It looks at the target: along -z of the camera.
  EXPECT_NEAR(glm::length(glm::normalize(Vec3(-5, -2, 0)) + Vec3(quarter.camera_to_world[2])), 0.0F, 1e-5F);
  viewpoint.up = Vec3(0, 0, 2);
  EXPECT_NEAR(glm::length(eye_of(camera_at(viewpoint, bounds, 1.0F, 1.75)) - Vec3(3, 0, 5)), 0.0F, 1e-5F);
}

TEST(Viewpoint, ThatSeesNothingIsRefused) {
  const Box bounds{Vec3(-1), Vec3(1)};
  Viewpoint viewpoint;
  EXPECT_NO_THROW((void)camera_at(viewpoint, bounds, 1.0F));
  viewpoint.eye = Vec3(0, 3, 0);
  EXPECT_THROW((void)camera_at(viewpoint, bounds, 1.0F), UsageError);
  viewpoint.eye = Vec3(0);
  EXPECT_THROW((void)camera_at(viewpoint, bounds, 1.0F), UsageError);
}

}  // namespace
}  // namespace grove::testing
