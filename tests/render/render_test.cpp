#include "grove/render/render.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>

#include "grove/base/error.h"
#include "grove/render/camera_rays.h"
#include "test_scenes.h"

namespace grove {
namespace {

using ::testing::HasSubstr;
using testing::SceneMaker;

template <typename Exception, typename Function>
std::string message_of(const Function& function) {
  try {
    function();
  } catch (const Exception& error) {
    return error.what();
  }
  return "no error";
}

Scene lone_sphere() {
  SceneMaker maker;
  maker.sphere({{4.0F, 0.0F, 0.0F}, 1.0F}, maker.material(SceneMaker::diffuse(Vec3(0.5F))));
  return maker.make();
}

TEST(Render, StoppedWorkKeepsTheFirstSamplesOfEachPixel) {
  const Scene scene = testing::mixed_scene();
  const SceneAccelerator accelerator(scene, "bvh");
  RenderSettings settings = testing::small_settings(64, 7);
  constexpr std::uint64_t kPixels = 64 * 64;
  std::stop_source source;
  ProgressReporter progress;
  progress.stop = source.get_token();
  progress.report = [&](std::uint64_t done, std::uint64_t total) {
    EXPECT_EQ(total, 7 * kPixels);
    if (done >= 4 * kPixels + 700) source.request_stop();
  };
  RenderResult part;
  oneapi::tbb::task_arena(1).execute([&] { part = render(scene, accelerator, settings, progress); });
  EXPECT_TRUE(part.interrupted);
  // One thread stops after the tile in which the pixels passed the mark: that tile has all seven samples, the pass before had four.
  EXPECT_EQ(part.completed_fraction, (4.0 * kPixels + 768.0) / (7.0 * kPixels));
  int finished = 0;
  for (const std::uint32_t count : {4U, 7U}) {
    settings.samples_per_pixel = count;
    const RenderResult whole = render(scene, accelerator, settings);
    EXPECT_FALSE(whole.interrupted);
    EXPECT_EQ(whole.completed_fraction, 1.0);
    for (std::uint32_t y = 0; y < 64; ++y) {
      for (std::uint32_t x = 0; x < 64; ++x) {
        if (part.film.pixel(x, y).sample_count != count) continue;
        ++finished;
        EXPECT_EQ(part.film.mean(x, y).radiance, whole.film.mean(x, y).radiance);
      }
    }
  }
  EXPECT_EQ(finished, kPixels) << "each pixel has four samples or all";
}

TEST(Render, StoppedBeforeItStartsGivesAnEmptyPicture) {
  std::stop_source source;
  source.request_stop();
  ProgressReporter progress;
  progress.stop = source.get_token();
  const Scene scene = lone_sphere();
  const RenderResult result = render(scene, SceneAccelerator(scene, "bvh"), testing::small_settings(20, 1), progress);
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(result.completed_fraction, 0.0);
  EXPECT_EQ(result.rays_traced, 0U);
}

TEST(Render, SceneWithoutCameraOrLightIsFramedAndLit) {
  const Scene scene = lone_sphere();
  const RenderResult result = testing::render_scene(scene, testing::small_settings(33, 4));
  EXPECT_TRUE(result.camera.empty());
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_THAT(result.warnings.front(), HasSubstr("no light"));
  RenderSettings settings = testing::small_settings(33, 4);
  settings.integrator = Integrator::depth;
  const RenderResult depth = testing::render_scene(scene, settings);
  EXPECT_GT(depth.film.mean(16, 16).radiance.x, 0.0F);  // the sphere is in the middle
  EXPECT_EQ(depth.film.mean(0, 0).radiance.x, 0.0F);    // and whole
  EXPECT_EQ(depth.film.mean(32, 32).radiance.x, 0.0F);
  EXPECT_TRUE(depth.warnings.empty());
}

TEST(Render, CamerasAreChosenByName) {
  SceneMaker maker;
  maker.sphere({{0.0F, 0.0F, 0.0F}, 1.0F}, maker.material(SceneMaker::diffuse(Vec3(0.5F))));
  maker.camera({0, 0, 5}, {0, 0, 0});
  maker.camera({0, 0, 9}, {0, 0, 0});
  maker.scene().cameras[0].name = "near";
  maker.scene().cameras[1].name = "far";
  const Scene scene = maker.make();
  RenderSettings settings = testing::small_settings(5, 1);
  settings.integrator = Integrator::depth;
  EXPECT_NEAR(testing::render_scene(scene, settings).film.mean(2, 2).radiance.x, 4.0F, 0.1F);
  settings.camera = "far";
  const RenderResult far = testing::render_scene(scene, settings);
  EXPECT_EQ(far.camera, "far");
  EXPECT_NEAR(far.film.mean(2, 2).radiance.x, 8.0F, 0.1F);
  settings.camera = "top";
  const std::string message = message_of<UsageError>([&] { (void)testing::render_scene(scene, settings); });
  EXPECT_THAT(message, HasSubstr("'top'"));
  EXPECT_THAT(message, HasSubstr("'near', 'far'"));
}

TEST(Render, SizeFollowsTheFilmAndKeepsItsAspect) {
  Scene scene = lone_sphere();
  scene.film = {40, 20};
  RenderSettings settings;
  settings.samples_per_pixel = 1;
  EXPECT_EQ(testing::render_scene(scene, settings).film.width(), 40U);
  settings.width = 10;
  EXPECT_EQ(testing::render_scene(scene, settings).film.height(), 5U);
  settings.width = 0;
  settings.height = 10;
  EXPECT_EQ(testing::render_scene(scene, settings).film.width(), 20U);
  settings.height = 1U << 20;
  EXPECT_THAT(message_of<UsageError>([&] { (void)testing::render_scene(scene, settings); }), HasSubstr("too large"));
  settings.height = 4;
  settings.samples_per_pixel = 0;
  EXPECT_THAT(message_of<UsageError>([&] { (void)testing::render_scene(scene, settings); }), HasSubstr("sample"));
}

TEST(Render, IntegratorsHaveNames) {
  for (const std::string_view name : integrator_names())
    EXPECT_EQ(integrator_names()[static_cast<std::size_t>(integrator_from_name(name))], name);
  EXPECT_THAT(message_of<UsageError>([] { (void)integrator_from_name("bdpt"); }), HasSubstr("path, ao, normal, depth, cost"));
}

TEST(Render, SimpleIntegratorsShowWhatTheySay) {
  SceneMaker maker;
  const std::uint32_t grey = maker.material(SceneMaker::diffuse(Vec3(0.5F)));
  maker.quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, grey);
  maker.quad({-9, -9, 1}, {0, 18, 0}, {9, 0, 0}, grey);  // its outer side faces away
  maker.camera({0.0F, 0.0F, 4.0F}, {0.0F, 0.0F, 0.0F});
  const Scene scene = maker.make();
  RenderSettings settings = testing::small_settings(9, 16);
  settings.integrator = Integrator::normal;
  const RenderResult normal = testing::render_scene(scene, settings);
  for (const std::uint32_t x : {0U, 8U}) {  // turned to the viewer on both
    EXPECT_NEAR(normal.film.mean(x, 4).radiance.z, 1.0F, 1e-4F);
    EXPECT_NEAR(normal.film.mean(x, 4).radiance.x, 0.5F, 1e-4F);
  }
  settings.integrator = Integrator::ao;
  settings.ao_distance = 0.5F;
  EXPECT_NEAR(testing::render_scene(scene, settings).film.mean(8, 4).radiance.y, 1.0F, 1e-5F);
  settings.integrator = Integrator::cost;
  const Vec3 cost = testing::render_scene(scene, settings, "brute").film.mean(4, 4).radiance;
  EXPECT_EQ(cost.y, 4.0F);
  EXPECT_EQ(cost.z, cost.x + cost.y);
}

TEST(CameraRays, FieldOfViewSpansTheAxisItNames) {
  Camera camera;
  camera.field_of_view = 1.0F;
  const float edge = std::tan(0.5F);
  camera.axis = FieldOfViewAxis::vertical;
  const Vec3 top = CameraRays(camera, 200, 100).ray({100.0F, 0.0F}, {0.5F, 0.5F}).direction;
  EXPECT_NEAR(top.y / -top.z, edge, 1e-5F);
  camera.axis = FieldOfViewAxis::horizontal;
  const Vec3 right = CameraRays(camera, 200, 100).ray({200.0F, 50.0F}, {0.5F, 0.5F}).direction;
  EXPECT_NEAR(right.x / -right.z, edge, 1e-5F);
  camera.axis = FieldOfViewAxis::smaller;
  const Vec3 wide = CameraRays(camera, 200, 100).ray({100.0F, 0.0F}, {0.5F, 0.5F}).direction;
  EXPECT_NEAR(wide.y / -wide.z, edge, 1e-5F);
  const Vec3 tall = CameraRays(camera, 100, 200).ray({100.0F, 100.0F}, {0.5F, 0.5F}).direction;
  EXPECT_NEAR(tall.x / -tall.z, edge, 1e-5F);
}

TEST(CameraRays, LensFocusesAtItsDistance) {
  Camera camera = look_at({1, 2, 3}, {1, 2, -7}, {0, 1, 0}, 0.8F);
  camera.lens_radius = 0.5F;
  camera.focus_distance = 4.0F;
  const CameraRays rays(camera, 64, 64);
  const Ray a = rays.ray({20.0F, 40.0F}, {0.1F, 0.9F});
  const Ray b = rays.ray({20.0F, 40.0F}, {0.8F, 0.3F});
  EXPECT_GT(glm::length(a.origin - b.origin), 0.1F);
  const Vec3 on_a = a.at((-1.0F - a.origin.z) / a.direction.z);
  const Vec3 on_b = b.at((-1.0F - b.origin.z) / b.direction.z);
  EXPECT_NEAR(glm::length(on_a - on_b), 0.0F, 1e-4F);
}

TEST(CameraRays, BadCamerasAreRefused) {
  Camera camera;
  camera.name = "broken";
  camera.field_of_view = 4.0F;
  EXPECT_THAT(message_of<InputError>([&] { CameraRays(camera, 8, 8); }), HasSubstr("'broken'"));
  camera.field_of_view = 1.0F;
  camera.camera_to_world = Mat4(0.0F);
  EXPECT_THAT(message_of<InputError>([&] { CameraRays(camera, 8, 8); }), HasSubstr("inverted"));
}

TEST(Film, DropsWhatIsNoLight) {
  Film film(2, 1);
  EXPECT_TRUE(film.add(0, 0, {.radiance = Vec3(1.0F)}));
  EXPECT_FALSE(film.add(0, 0, {.radiance = Vec3(std::nanf(""), 0.0F, 0.0F)}));
  EXPECT_FALSE(film.add(0, 0, {.radiance = Vec3(0.0F, INFINITY, 0.0F)}));
  EXPECT_FALSE(film.add(0, 0, {.radiance = Vec3(0.0F, 0.0F, -1.0F)}));
  EXPECT_TRUE(film.add(0, 0, {.radiance = Vec3(3.0F)}));
  EXPECT_EQ(film.mean(0, 0).radiance, Vec3(2.0F));
  EXPECT_EQ(film.mean(1, 0).radiance, Vec3(0.0F));
  EXPECT_EQ(film.pixel(0, 0).taken(), 5U);
  EXPECT_EQ(film.pixel(0, 0).sample_count, 2U);
  EXPECT_EQ(film.dropped_samples(), 3U);
}

}  // namespace
}  // namespace grove
