// Paths that are traced together find what paths find that are traced one ray after another, bit for bit.

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <cstring>

#include "grove/render/integrator/path.h"
#include "grove/render/integrator/path_batch.h"
#include "grove/render/sample_batch.h"
#include "grove/scene/load.h"
#include "same_bits.h"
#include "test_scenes.h"

namespace grove {
namespace {

RenderSettings settings_with(RayCalls ray_calls, std::uint32_t max_depth = 8) {
  RenderSettings settings = testing::small_settings(0, 5, max_depth);
  settings.width = 35;
  settings.height = 21;  // tiles that stick out
  settings.seed = 7;
  settings.ray_calls = ray_calls;
  return settings;
}

// Sheets one behind another, between a camera and a lamp, that let this part of light pass.
Scene sheets(std::uint32_t count, float alpha) {
  testing::SceneMaker maker;
  Material sheet = testing::SceneMaker::diffuse({0.3F, 0.6F, 0.4F});
  sheet.alpha_mode = AlphaMode::blend;
  sheet.alpha.value = alpha;
  const std::uint32_t sheet_id = maker.material(sheet);
  const std::uint32_t wall = maker.material(testing::SceneMaker::diffuse(Vec3(0.8F)));
  const std::uint32_t lamp = maker.material(testing::SceneMaker::lamp(Vec3(5.0F)));
  for (std::uint32_t i = 0; i < count; ++i) maker.quad({-2, -2, 0.01F * static_cast<float>(i)}, {4, 0, 0}, {0, 4, 0}, sheet_id);
  maker.quad({-2, -2, -1}, {4, 0, 0}, {0, 4, 0}, wall);
  const float front = 0.01F * static_cast<float>(count);
  maker.quad({-1, -1, front + 3.0F}, {0, 0.5F, 0}, {0.5F, 0, 0}, lamp);
  maker.camera({0.1F, 0.2F, front + 2.0F}, {0, 0, 0});
  return maker.make();
}

void expect_same(const Scene& scene, const std::vector<const char*>& specs, std::uint32_t max_depth = 8, std::uint32_t samples = 5) {
  RenderSettings single = settings_with(RayCalls::single, max_depth);
  RenderSettings batches = settings_with(RayCalls::batches, max_depth);
  single.samples_per_pixel = batches.samples_per_pixel = samples;
  if (max_depth == 5) single.indirect_clamp = batches.indirect_clamp = 0.5F;
  const RenderResult reference = testing::render_scene(scene, single, "bvh");
  for (const char* const spec : specs) {
    const RenderResult result = testing::render_scene(scene, batches, spec);
    EXPECT_TRUE(testing::same_bits(reference.film, result.film)) << spec << ", depth " << max_depth;
    EXPECT_EQ(reference.rays_traced, result.rays_traced) << spec << ", depth " << max_depth;
  }
}

TEST(Batches, MakeTheSamePictureAtAnyDepth) {
  const Scene scene = testing::mixed_scene();
  for (const std::uint32_t max_depth : {0U, 1U, 5U}) expect_same(scene, {"fast"}, max_depth);
  expect_same(scene, {"fast", "bvh", "kdtree"}, 60);
}

TEST(Batches, MakeTheSamePictureOfBuiltInScenes) {
  for (const char* const name :
       {"builtin:cornell", "builtin:mount?triangles=2000", "builtin:tree?triangles=3000", "builtin:sphereflake?size=2"}) {
    SCOPED_TRACE(name);
    expect_same(load_scene(name), {"fast", "bvh"});
  }
}

TEST(Batches, MakeTheSamePictureForAnyNumberOfThreads) {
  const Scene scene = testing::mixed_scene();
  const SceneAccelerator accelerator(scene, "fast");
  const RenderResult reference = render(scene, accelerator, settings_with(RayCalls::single));
  const oneapi::tbb::global_control allowed(oneapi::tbb::global_control::max_allowed_parallelism, 4);
  for (const int threads : {1, 2, 4}) {
    RenderResult result;
    oneapi::tbb::task_arena(threads).execute([&] { result = render(scene, accelerator, settings_with(RayCalls::batches)); });
    EXPECT_TRUE(testing::same_bits(reference.film, result.film)) << threads;
    EXPECT_EQ(reference.rays_traced, result.rays_traced) << threads;
  }
}

TEST(Batches, PassThroughAlphaAlike) {
  expect_same(sheets(30, 0.05F), {"fast", "fast:nodes=compressed", "bvh", "octree"});
  expect_same(sheets(30, 0.0F), {"fast", "bvh"});
}

TEST(Batches, PassAnyNumberOfSheets) {
  expect_same(sheets(2000, 0.0F), {"fast"}, 1, 1);
  RenderSettings settings = settings_with(RayCalls::batches, 1);
  const Vec3 behind_many = testing::mean_radiance(testing::render_scene(sheets(2000, 0.0F), settings));
  EXPECT_GT(behind_many.y, 0.0F);
}

// A batch keeps its memory: what an earlier one left must not show.
TEST(Batches, OfAnySizeOneAfterAnother) {
  const Scene scene = testing::mixed_scene();
  const SceneAccelerator accelerator(scene, "fast");
  const PreparedScene world(scene, accelerator);
  const CameraRays camera(scene.cameras.front(), 64, 64);
  PathBatch batch(world, {});
  std::uint64_t rays_of_single = 0;
  for (const std::uint32_t size : {0U, 1U, 700U, 3U, static_cast<std::uint32_t>(SampleBatch::kSize) + 5U}) {
    std::vector<Sampler> samplers;
    std::vector<Ray> rays;
    std::vector<Film::Sample> expected;
    for (std::uint32_t i = 0; i < size; ++i) {
      const Sampler& sampler = samplers.emplace_back(size, i, 3, 0);
      rays.push_back(camera.ray({static_cast<float>(i & 63U), static_cast<float>(i >> 6U)}, Vec2(0.5F)));
      RayTracer tracer(world, sampler);
      expected.push_back(trace_path(world, {}, rays.back(), sampler, tracer));
      rays_of_single += tracer.rays_traced();
    }
    std::vector<Film::Sample> samples(size, {.radiance = Vec3(1e9F)});
    batch.trace(rays, samplers, samples);
    EXPECT_TRUE(size == 0 || std::memcmp(samples.data(), expected.data(), size * sizeof(Film::Sample)) == 0) << size;
    EXPECT_EQ(batch.rays_traced(), rays_of_single);
  }
}

}  // namespace
}  // namespace grove
