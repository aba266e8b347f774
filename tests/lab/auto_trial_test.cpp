#include "grove/lab/auto_trial.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "grove/lab/auto_choice.h"
#include "grove/lab/workload.h"
#include "lab/small_scene.h"

namespace grove {
namespace {

TEST(AutoTrial, HoldsTheChoiceAgainstTheQuickestOfAll) {
  const Scene scene = testing::small_scene();
  const SceneAccelerator accelerator(scene, "bvh");
  const std::vector<Ray> rays = make_rays(RayKind::random, scene, accelerator, workload_camera(scene, ""), {1000, 1});
  const std::vector<std::string> candidates{"brute", "bvh", "kdtree"};
  const std::vector<double> counts{1.0, 1e9};
  const std::vector<AutoTrial> trials = try_auto(scene, candidates, rays, counts, {.rounds = 1});
  ASSERT_EQ(trials.size(), 2U);
  EXPECT_EQ(trials[0].winner, "brute") << "building nothing is quickest where one ray is traced";
  EXPECT_NE(trials[1].winner, "brute");
  for (const AutoTrial& trial : trials) {
    EXPECT_GE(trial.choice_seconds, trial.winner_seconds);
    EXPECT_EQ(trial.picked_winner(), trial.choice.structure == trial.winner);
    EXPECT_GE(trial.regret(), 0.0);
    EXPECT_EQ(
        trial.choice.structure,
        choose_structure(sample_geometry(GeometryPointer(std::shared_ptr<const TriangleMesh>(std::get<0>(scene.objects.front().geometry)))),
                         {StructureUse::Kind::still, trial.rays})
            .structure);
  }
}

TEST(AutoChoice, IsForTheLargestObjectAndForAutoAlone) {
  EXPECT_FALSE(auto_choice(testing::small_scene(), "bvh").has_value());
  const auto choice = auto_choice(testing::instanced_scene(), "auto:rays=5");
  ASSERT_TRUE(choice.has_value());
  EXPECT_THAT(choice->reason, ::testing::HasSubstr("212 triangles"));
  EXPECT_THAT(choice->reason, ::testing::HasSubstr("largest object"));
}

}  // namespace
}  // namespace grove
