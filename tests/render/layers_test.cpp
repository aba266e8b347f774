// What is gathered beside the colours.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>

#include <filesystem>

#include "grove/base/error.h"
#include "grove/render/image/write_exr.h"
#include "render/same_bits.h"
#include "render/test_scenes.h"

namespace grove::testing {
namespace {

constexpr std::uint32_t kSide = 16;

RenderSettings gathering_settings(std::uint32_t samples) {
  RenderSettings settings = small_settings(kSide, samples, 1);
  settings.gathering.first_hits = true;
  return settings;
}

// A wall across the view at z = 0, seen from `eye` along -z, and a lamp far behind.
Scene wall(const Vec3& eye, float wall_x = 0.0F) {
  SceneMaker maker;
  const std::uint32_t white = maker.material(SceneMaker::diffuse(Vec3(0.5F)));
  maker.quad({wall_x - 50, -50, 0}, {100, 0, 0}, {0, 100, 0}, white);
  maker.scene().environment.radiance = Vec3(1.0F);
  maker.camera(eye, eye - Vec3(0, 0, 1), 1.0F);
  return maker.make();
}

TEST(Layers, AreNamed) {
  EXPECT_EQ(layers_from_text("all"), LayerSet::all());
  EXPECT_TRUE(layers_from_text("none").is_empty());
  EXPECT_EQ(layers_from_text("albedo,normal"), LayerSet::usual());
  for (std::size_t i = 0; i < layer_names().size(); ++i) EXPECT_TRUE(layers_from_text(layer_names()[i]).has(static_cast<Layer>(i))) << i;
  for (const char* text : {"", "albedo,", "depth,heat"}) EXPECT_THROW((void)layers_from_text(text), UsageError) << text;
}

TEST(Layers, DepthIsAlongTheViewingAxis) {
  const Scene scene = wall({0, 0, 4});
  const RenderResult result = render_scene(scene, gathering_settings(4));
  for (const std::uint32_t x : {0U, 8U, 15U}) {
    const FirstHit& hit = result.first_hits->at(x, 3);
    EXPECT_NEAR(hit.depth, 4.0F, 1e-4F);
    EXPECT_EQ(hit.motion, Vec2(0.0F));
    EXPECT_EQ(hit.geometry, 0U);
    EXPECT_NE(hit.primitive, kInvalidId);
  }
}

TEST(Layers, AreTheSameForAnyThreadsAndStructureAndLeaveTheFilmAlone) {
  const Scene scene = mixed_scene();
  RenderSettings settings = gathering_settings(3);
  const RenderResult with = render_scene(scene, settings, "bvh");
  const RenderResult other = render_scene(scene, settings, "kdtree");
  settings.gathering = {};
  const RenderResult without = render_scene(scene, settings);
  EXPECT_TRUE(same_bits(with.film, without.film));
  EXPECT_FALSE(without.first_hits);
  std::uint32_t missed = 0;
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const FirstHit& a = with.first_hits->at(x, y);
      const FirstHit& b = other.first_hits->at(x, y);
      EXPECT_EQ(a.depth, b.depth);
      EXPECT_EQ(a.primitive, b.primitive);
      EXPECT_EQ(a.instance, b.instance);
      EXPECT_EQ(a.emitted, b.emitted);
      if (a.primitive == kInvalidId) ++missed;
      if (a.depth == FirstHit::kNothing) {
        EXPECT_EQ(with.film.mean(x, y).normal, Vec3(0.0F));
        EXPECT_EQ(a.emitted, with.film.mean(x, y).radiance) << "nothing but sky";
      }
    }
  }
  EXPECT_GT(missed, 0U);
}

TEST(Layers, MotionFollowsTheCamera) {
  const Scene before = wall({1.0F, 0, 4});
  const Scene now = wall({0, 0.5F, 4});
  const EarlierFrame earlier{ScenePose(before), CameraRays(before.cameras[0], kSide, kSide)};
  RenderSettings settings = gathering_settings(2);
  settings.gathering.earlier = &earlier;
  const RenderResult result = render_scene(now, settings);
  // The view at depth 4 is 8 tan(0.5) wide.
  const float pixels_per_unit = kSide / (8.0F * std::tan(0.5F));
  for (const std::uint32_t x : {1U, 8U, 14U}) {
    const FirstHit& hit = result.first_hits->at(x, 5);
    EXPECT_NEAR(hit.motion.x, pixels_per_unit, 1e-3F) << "the camera went left, what it sees to the right";
    EXPECT_NEAR(hit.motion.y, 0.5F * pixels_per_unit, 1e-3F) << "and up, so that it sees it further down";
    EXPECT_NEAR(hit.earlier_depth, 4.0F, 1e-4F);
  }
}

TEST(Layers, MotionFollowsObjects) {
  // A sphere that moves and grows and a wall whose vertices move, seen from the same place.
  const auto scene_at = [](float time) {
    SceneMaker maker;
    const std::uint32_t white = maker.material(SceneMaker::diffuse(Vec3(0.5F)));
    maker.quad({-50.0F + time, -50, 0}, {100, 0, 0}, {0, 100, 0}, white);
    maker.sphere({{0, 0, 0}, 1.0F}, white, Mat4(Vec4(1, 0, 0, 0), Vec4(0, 1, 0, 0), Vec4(0, 0, 1, 0), Vec4(0, 0.5F * time, 2, 1)));
    maker.camera({0, 0, 6}, {0, 0, 0}, 1.0F);
    return maker.make();
  };
  const Scene before = scene_at(0.0F);
  const Scene now = scene_at(1.0F);
  EXPECT_TRUE(ScenePose(now).is_pose_of(now));
  EXPECT_FALSE(ScenePose(before).is_pose_of(now));
  const EarlierFrame earlier{ScenePose(before), CameraRays(before.cameras[0], kSide, kSide)};
  RenderSettings settings = gathering_settings(8);
  settings.gathering.earlier = &earlier;
  const RenderResult result = render_scene(now, settings);
  const FirstHit& on_wall = result.first_hits->at(0, 15);
  EXPECT_NEAR(on_wall.motion.x, kSide / (12.0F * std::tan(0.5F)), 1e-3F);
  EXPECT_NEAR(on_wall.motion.y, 0.0F, 1e-4F);
  const FirstHit& on_sphere = result.first_hits->at(8, 7);
  EXPECT_NE(on_sphere.instance, on_wall.instance);
  EXPECT_NEAR(on_sphere.motion.x, 0.0F, 0.05F);
  EXPECT_LT(on_sphere.motion.y, -0.8F) << "up in the world, which is less of y";
}

TEST(Layers, StandInTheFileUnderTheirNames) {
  const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / "grove_layers.exr";
  const Scene scene = mixed_scene();
  RenderResult result = render_scene(scene, gathering_settings(2));
  result.denoised = ColourImage(kSide, kSide);
  write_exr(result, LayerSet::all(), path);
  Imf::InputFile file(path.string().c_str());
  std::vector<std::string> names;
  for (auto channel = file.header().channels().begin(); channel != file.header().channels().end(); ++channel)
    names.emplace_back(channel.name());
  EXPECT_THAT(names, ::testing::UnorderedElementsAre("R", "G", "B", "albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y", "normal.Z",
                                                     "depth.Z", "motion.U", "motion.V", "variance.Y", "samples.Y", "id.primitive",
                                                     "id.geometry", "id.instance", "noisy.R", "noisy.G", "noisy.B"));
  EXPECT_EQ(file.header().channels()["id.primitive"].type, Imf::UINT);
  std::vector<std::uint32_t> ids(kSide * kSide);
  std::vector<float> noisy(kSide * kSide);
  std::vector<float> samples(kSide * kSide);
  Imf::FrameBuffer frame;
  frame.insert("id.instance", Imf::Slice(Imf::UINT, reinterpret_cast<char*>(ids.data()), 4, 4 * kSide));
  frame.insert("noisy.G", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(noisy.data()), 4, 4 * kSide));
  frame.insert("samples.Y", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(samples.data()), 4, 4 * kSide));
  file.setFrameBuffer(frame);
  file.readPixels(0, kSide - 1);
  for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
    EXPECT_EQ(ids[i], result.first_hits->at(i % kSide, i / kSide).instance);
    EXPECT_EQ(noisy[i], result.film.mean(i % kSide, i / kSide).radiance.y);
    EXPECT_EQ(samples[i], 2.0F);
  }
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace grove::testing
