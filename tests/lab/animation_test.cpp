#include "grove/lab/animation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stop_token>

#include "grove/base/error.h"
#include "grove/lab/animation_report.h"
#include "grove/scene/load.h"

namespace grove {
namespace {

AnimationSettings few_frames() {
  AnimationSettings settings;
  settings.frames = 4;
  settings.workload.ray_count = 2000;
  return settings;
}

TEST(Animation, EveryWayGivesTheHitsOfAStructureBuiltAnew) {
  for (const char* scene : {"builtin:twist?size=5", "builtin:shatter?size=12"}) {
    for (const char* structure : {"bvh", "bvh:arity=8", "brute"}) {
      AnimationSettings settings = few_frames();
      settings.structure = structure;
      const Animation animation = animate(moving_scene(scene), settings);
      ASSERT_EQ(animation.rows.size(), 16U);
      for (const AnimationRow& row : animation.rows) {
        EXPECT_EQ(row.mismatches, 0U) << scene << " " << structure << " " << name_of(row.policy) << " in frame " << row.frame;
        EXPECT_GT(row.mrays_per_s, 0.0);
      }
      EXPECT_EQ(animation.rows.back().time, 1.0);
    }
  }
}

TEST(Animation, RefittingAloneGetsDearerThanRebuilding) {
  AnimationSettings settings = few_frames();
  settings.policies = {UpdatePolicy::refit, UpdatePolicy::rebuild};
  const Animation animation = animate(moving_scene("builtin:shatter?size=20"), settings);
  const AnimationRow& refitted = animation.rows[6];
  const AnimationRow& rebuilt = animation.rows[7];
  EXPECT_GT(refitted.update.cost, 2.0 * rebuilt.update.cost);
  EXPECT_GT(refitted.nodes_per_ray, 2.0 * rebuilt.nodes_per_ray);
}

TEST(Animation, RefusesScenesThatDoNotMove) {
  EXPECT_THROW(moving_scene("builtin:tree"), UsageError);
  EXPECT_THROW(moving_scene("scene.glb"), UsageError);
  // A time of one's own stands against that of the frame.
  EXPECT_THROW(animate(moving_scene("builtin:twist?size=2&time=0.5"), few_frames()), UsageError);
  // Other triangles in each frame.
  const MovingScene growing = [](double time) { return load_scene(time > 0.0 ? "builtin:twist?size=3" : "builtin:twist?size=2"); };
  EXPECT_THROW(animate(growing, few_frames()), InputError);
}

TEST(Animation, StopsAfterAFrame) {
  std::stop_source source;
  ProgressReporter progress{[&](std::uint64_t done, std::uint64_t /*total*/) {
                              if (done == 2) source.request_stop();
                            },
                            source.get_token()};
  EXPECT_EQ(animate(moving_scene("builtin:twist?size=2"), few_frames(), progress).rows.size(), 8U);
}

TEST(Animation, IsReportedRowByRow) {
  const Animation animation = animate(moving_scene("builtin:twist?size=2"), few_frames());
  const auto json = animation_json(animation);
  ASSERT_EQ(json.at("rows").size(), 16U);
  EXPECT_EQ(json.at("rows")[3].at("policy"), "rebuild");
  EXPECT_EQ(json.at("rows")[3].at("method"), "rebuild");
  const std::string csv = animation_csv(animation);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 17);
  EXPECT_NE(animation_table(animation).find("rebuild 4"), std::string::npos);
}

}  // namespace
}  // namespace grove
