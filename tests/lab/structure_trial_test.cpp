#include "grove/lab/structure_trial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "grove/base/error.h"
#include "grove/lab/scattered_geometry.h"
#include "lab/small_scene.h"

namespace grove::testing {
namespace {

TEST(StructureTrial, BuildsAndTracesEachInTurn) {
  const Scene scene = small_scene();
  const std::vector<Ray> rays = rays_inside({Vec3(0.0F), Vec3(1.0F)}, 300, 3);
  const std::array<std::string, 3> specs{"brute", "bvh:split=binned", "octree"};
  const std::vector<StructureTrial> trials = try_structures(scene, specs, rays, {.rounds = 2, .build_rounds = 3});
  ASSERT_EQ(trials.size(), 3U);
  EXPECT_EQ(trials[1].structure, "bvh") << "the canonical spec";
  EXPECT_EQ(trials[0].tests, 212.0) << "brute force tests every primitive";
  for (const StructureTrial& trial : trials) {
    EXPECT_EQ(trial.build_seconds.size(), 3U);
    ASSERT_EQ(trial.nanoseconds.size(), 2U);
    EXPECT_GT(*std::ranges::min_element(trial.nanoseconds), 0.0);
    EXPECT_LE(trial.tests, trials[0].tests);
    EXPECT_EQ(trial.steps(), trial.nodes + trial.tests);
  }
  EXPECT_GT(trials[1].statistics.bytes, 0U);
}

TEST(StructureTrial, SaysWhatIsWrong) {
  const Scene scene = small_scene();
  const std::vector<Ray> rays = rays_inside({Vec3(0.0F), Vec3(1.0F)}, 10, 3);
  EXPECT_THROW(static_cast<void>(try_structures(scene, std::array<std::string, 1>{"bush"}, rays)), UsageError);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(static_cast<void>(try_structures(scene, std::array<std::string, 1>{"bvh"}, rays, {.stop = stop.get_token()})), Stopped);
}

TEST(RatiosByRound, AreTakenRoundByRound) {
  EXPECT_EQ(ratios_by_round(std::array{2.0, 9.0}, std::array{1.0, 3.0}), (std::vector{2.0, 3.0}));
}

}  // namespace
}  // namespace grove::testing
