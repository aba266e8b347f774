// The same seed gives the same picture, bit for bit, whatever the threads and the structure.

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include "grove/registry/registry.h"
#include "same_bits.h"
#include "test_scenes.h"

namespace grove {
namespace {

RenderSettings settings_for(Integrator integrator) {
  RenderSettings settings = testing::small_settings(0, 3);
  settings.width = 50;
  settings.height = 37;  // tiles that stick out
  settings.integrator = integrator;
  settings.seed = 99;
  return settings;
}

std::string integrator_name(const ::testing::TestParamInfo<Integrator>& which) {
  return std::string(integrator_names()[static_cast<std::size_t>(which.param)]);
}

class EveryIntegrator : public ::testing::TestWithParam<Integrator> {};
INSTANTIATE_TEST_SUITE_P(Integrators, EveryIntegrator,
                         ::testing::Values(Integrator::path, Integrator::ao, Integrator::normal, Integrator::depth, Integrator::cost),
                         integrator_name);

TEST_P(EveryIntegrator, PictureDoesNotDependOnThreads) {
  const Scene scene = testing::mixed_scene();
  const SceneAccelerator accelerator(scene, "bvh");
  const RenderSettings settings = settings_for(GetParam());
  // More threads than the machine may have.
  const oneapi::tbb::global_control allowed(oneapi::tbb::global_control::max_allowed_parallelism, 4);
  RenderResult one;
  RenderResult two;
  RenderResult four;
  oneapi::tbb::task_arena(1).execute([&] { one = render(scene, accelerator, settings); });
  oneapi::tbb::task_arena(2).execute([&] { two = render(scene, accelerator, settings); });
  oneapi::tbb::task_arena(4).execute([&] { four = render(scene, accelerator, settings); });
  EXPECT_TRUE(testing::same_bits(one.film, two.film));
  EXPECT_TRUE(testing::same_bits(one.film, four.film));
  EXPECT_EQ(one.rays_traced, two.rays_traced);
  EXPECT_GT(testing::mean_radiance(one).y, 0.0F);
}

// `cost` shows the structure.
class StructureFreeIntegrator : public EveryIntegrator {};
INSTANTIATE_TEST_SUITE_P(Integrators, StructureFreeIntegrator,
                         ::testing::Values(Integrator::path, Integrator::ao, Integrator::normal, Integrator::depth), integrator_name);

TEST_P(StructureFreeIntegrator, PictureDoesNotDependOnTheStructure) {
  const Scene scene = testing::mixed_scene();
  const RenderSettings settings = settings_for(GetParam());
  const RenderResult reference = testing::render_scene(scene, settings, "brute");
  for (const std::string_view spec : representative_specs()) {
    const RenderResult other = testing::render_scene(scene, settings, std::string(spec).c_str());
    EXPECT_TRUE(testing::same_bits(reference.film, other.film)) << spec;
    EXPECT_EQ(reference.rays_traced, other.rays_traced) << spec;
  }
}

TEST(Determinism, SeedsDiffer) {
  const Scene scene = testing::mixed_scene();
  const SceneAccelerator accelerator(scene, "bvh");
  RenderSettings settings = settings_for(Integrator::path);
  const RenderResult first = render(scene, accelerator, settings);
  settings.seed = 100;
  EXPECT_FALSE(testing::same_bits(first.film, render(scene, accelerator, settings).film));
}

}  // namespace
}  // namespace grove
