// Closest hits beside Embree's: at least 99.99 % of random rays agree (t within 1e-4), and exact arithmetic explains each that does not.

#include <gtest/gtest.h>

#include <filesystem>

#include "grove/lab/workload.h"
#include "grove/scene/load.h"
#include "trace/agreement.h"
#include "trace/contender.h"
#include "trace/world_mesh.h"

namespace grove::bench {
namespace {

class Agreement : public testing::TestWithParam<std::string> {};

TEST_P(Agreement, WithEmbree) {
  std::string source = GetParam();
  if (!source.starts_with("builtin:")) {
    source = std::string(GROVE_SOURCE_DIR) + "/../shared/scenes/" + source;
    if (!std::filesystem::exists(source)) GTEST_SKIP() << source << " is not there";
  }
  const Scene loaded = load_scene(source);
  const auto mesh = world_mesh(loaded);
  const Scene scene = scene_of(loaded, mesh);
  const SceneAccelerator accelerator(scene, kDefaultSpec);
  const std::vector<Ray> rays =
      make_rays(RayKind::random, scene, accelerator, workload_camera(scene, ""), {.ray_count = 100'000, .seed = 3});
  const auto grove = make_grove(mesh, std::string(kDefaultSpec));
  const auto embree = make_embree(mesh);
  grove->build(2);
  embree->build(1);
  std::vector<Hit> hits(rays.size());
  std::vector<Hit> rival_hits(rays.size());
  grove->intersect(rays, hits);
  embree->intersect(rays, rival_hits);
  const auto result = compare_hits(*mesh, rays, hits, rival_hits);
  EXPECT_GT(result.hits, 0U);
  EXPECT_GE(static_cast<double>(result.agreeing), 0.9999 * static_cast<double>(result.rays));
  EXPECT_EQ(result.unexplained, 0U) << (result.examples.empty() ? "" : result.examples.front());

  // Any hit agrees with the own closest hit everywhere.
  std::vector<std::uint8_t> occluded(rays.size());
  grove->occluded(rays, occluded);
  for (std::size_t i = 0; i < rays.size(); ++i) EXPECT_EQ(occluded[i] != 0, static_cast<bool>(hits[i])) << i;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Agreement,
                         testing::Values("builtin:cornell", "builtin:mount?triangles=50000", "builtin:soup?triangles=20000",
                                         "builtin:tree?triangles=50000", "builtin:gears", "classroom/scene-v4.pbrt",
                                         "coffee-maker/scene-v4.pbrt", "stanford-scans/bun_zipper.ply"),
                         [](const auto& test) {
                           std::string name = test.param;
                           for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
                           return name;
                         });

}  // namespace
}  // namespace grove::bench
