#include "grove/lab/scale_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "grove/base/error.h"
#include "grove/lab/scale_report.h"

namespace grove {
namespace {

ScaleSettings small_study() {
  ScaleSettings settings;
  settings.scene = "builtin:soup?seed=3";
  settings.sizes = {100, 400, 1600};
  settings.structures = {"brute", "bvh"};
  settings.rays = RayKind::random;
  settings.workload.ray_count = 500;
  settings.rounds = 2;
  return settings;
}

const ScaleFit& fit_of(const ScaleStudy& study, const std::string& structure) {
  return *std::ranges::find(study.fits, structure, &ScaleFit::structure);
}

TEST(ScaleStudy, MeasuresEachStructureAtEachSizeAndFitsExponents) {
  std::vector<std::size_t> saved;
  const ScaleStudy study = study_scale(small_study(), [&](const ScaleStudy& so_far) { saved.push_back(so_far.rows.size()); });
  EXPECT_TRUE(study.is_complete);
  EXPECT_THAT(saved, ::testing::ElementsAre(2, 4, 6));
  ASSERT_EQ(study.rows.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(study.rows[i].primitives, small_study().sizes[i / 2]);
    EXPECT_EQ(study.rows[i].structure, i % 2 == 0 ? "brute" : "bvh");
    EXPECT_EQ(study.rows[i].error, "");
    EXPECT_GT(study.rows[i].build_seconds.median, 0.0);
    EXPECT_GT(study.rows[i].mrays_per_s.median, 0.0);
  }
  ASSERT_EQ(study.fits.size(), 2U);
  EXPECT_NEAR(fit_of(study, "brute").steps.exponent, 1.0, 0.2) << "most rays test every triangle";
  EXPECT_NEAR(fit_of(study, "bvh").memory.exponent, 1.0, 0.1);
  EXPECT_LT(fit_of(study, "bvh").steps.exponent, fit_of(study, "brute").steps.exponent);
  EXPECT_EQ(fit_of(study, "brute").memory.factor, 0.0) << "nothing grows where nothing is";
}

TEST(ScaleStudy, AStructureThatFailsIsNotTriedAtLargerSizes) {
  ScaleSettings settings = small_study();
  std::vector<std::string> tried;
  settings.trial_build = [&](const std::string& scene, const std::string& spec) {
    tried.push_back(scene + ' ' + spec);
    return spec == "bvh" && scene.ends_with("=400") ? std::string("too large") : std::string();
  };
  const ScaleStudy study = study_scale(settings);
  EXPECT_EQ(study.rows[1].error, "");
  EXPECT_EQ(study.rows[3].error, "too large");
  EXPECT_THAT(study.rows[5].error, ::testing::HasSubstr("smaller size: too large"));
  EXPECT_EQ(study.rows[4].error, "");
  EXPECT_THAT(tried, ::testing::Contains("builtin:soup?seed=3&primitives=400 bvh"));
  EXPECT_THAT(tried, ::testing::Not(::testing::Contains("builtin:soup?seed=3&primitives=1600 bvh")));
  EXPECT_THAT(scale_text(study), ::testing::HasSubstr("failed: bvh at 400 primitives: too large"));
  EXPECT_EQ(study.fits.size(), 1U) << "one size is no growth";
}

TEST(ScaleStudy, KeepsTheSizesThatAreFinishedWhenStopped) {
  std::stop_source stop;
  const ScaleStudy study = study_scale(small_study(), [&](const ScaleStudy&) { stop.request_stop(); }, {{}, stop.get_token()});
  EXPECT_EQ(study.rows.size(), 2U);
  EXPECT_FALSE(study.is_complete);
}

TEST(ScaleStudy, NeedsABuiltInScene) {
  ScaleSettings settings = small_study();
  settings.scene = "scene.glb";
  EXPECT_THROW(static_cast<void>(study_scale(settings)), UsageError);
  settings.scene = "builtin:soup?size=5";
  EXPECT_THROW(static_cast<void>(study_scale(settings)), UsageError) << "it has a size";
}

TEST(ScaleSizes, AreOneAndThreeOfEachDecade) {
  EXPECT_THAT(scale_sizes(40'000), ::testing::ElementsAre(1000, 3000, 10'000, 30'000));
  EXPECT_THAT(scale_sizes(999), ::testing::IsEmpty());
  EXPECT_EQ(scale_sizes(10'000'000).back(), 10'000'000U);
}

TEST(ScaleReport, JsonHasTheAgreedKeys) {
  const nlohmann::ordered_json json = scale_json(study_scale(small_study()));
  EXPECT_EQ(json.at("format"), "grove-scale");
  EXPECT_EQ(json.at("version"), 1);
  EXPECT_EQ(json.at("sizes"), (std::vector<int>{100, 400, 1600}));
  for (const char* const key :
       {"structure", "primitives", "build_seconds", "bytes", "steps_per_ray", "nodes_per_ray", "tests_per_ray", "mrays_per_s"})
    EXPECT_TRUE(json.at("rows").at(1).contains(key)) << key;
  for (const char* const key : {"build", "memory", "steps"}) EXPECT_TRUE(json.at("fits").at(1).at(key).at("exponent").is_number()) << key;
  EXPECT_EQ(json.at("sections").size(), 4U);
}

}  // namespace
}  // namespace grove
