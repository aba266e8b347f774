#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "cli/run_command.h"
#include "grove/base/random.h"
#include "grove/lab/ray_file.h"
#include "grove/render/scene_accelerator.h"
#include "grove/scene/load.h"

namespace grove::testing {
namespace {

using ::testing::HasSubstr;

constexpr char kScene[] = "builtin:gears";

class Trace : public ::testing::Test {
 protected:
  Trace() {
    const Box bounds = accelerator_.top().bounds();
    Random random(4);
    for (Ray& ray : rays_) {
      for (int axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = random.next_float(bounds.lower[axis], bounds.upper[axis]);
        ray.direction[axis] = random.next_float(-1.0F, 1.0F);
      }
    }
    write_rays(directory_ / "rays.npy", rays_);
  }

  /// The records of hits.npy.
  std::vector<Hit> read_hits() const {
    const std::string bytes = read_file(directory_ / "hits.npy");
    std::vector<Hit> hits(rays_.size());
    EXPECT_GT(bytes.size(), hits.size() * sizeof(Hit));
    if (bytes.size() > hits.size() * sizeof(Hit)) {
      std::memcpy(hits.data(), bytes.data() + bytes.size() - hits.size() * sizeof(Hit), hits.size() * sizeof(Hit));
    }
    return hits;
  }

  CommandResult trace(std::vector<std::string> more, const CommandSettings& settings = {}) const {
    std::vector<std::string> arguments{"trace", kScene, "--rays", "rays.npy", "--hits", "hits.npy"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_command(directory_, arguments, settings);
  }

  TemporaryDirectory directory_;
  Scene scene_ = load_scene(kScene);
  SceneAccelerator accelerator_{scene_, "bvh"};
  std::vector<Ray> rays_ = std::vector<Ray>(3000);
};

TEST_F(Trace, WritesTheClosestHits) {
  const CommandResult result = trace({"--json", "trace.json", "--repeat", "3", "--threads", "2"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const std::vector<Hit> hits = read_hits();
  std::size_t hit_count = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    EXPECT_EQ(hits[i], accelerator_.top().intersect(rays_[i])) << i;
    hit_count += hits[i] ? 1 : 0;
  }
  EXPECT_GT(hit_count, 100U);
  EXPECT_EQ(directory_.entry_count(), 3U) << "a temporary file is left";

  const auto json = nlohmann::json::parse(read_file(directory_ / "trace.json"));
  for (const char* key : {"structure", "primitives", "references", "nodes", "leaves", "depth", "bytes", "build_seconds", "expected_cost"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_EQ(json.at("threads"), 2);
  EXPECT_EQ(json.at("rays"), 3000);
  EXPECT_EQ(json.at("query"), "closest");
  EXPECT_GT(json.at("mrays_per_s").at("min"), 0.0);
  EXPECT_LE(json.at("mrays_per_s").at("min"), json.at("mrays_per_s").at("median"));
  EXPECT_LE(json.at("mrays_per_s").at("median"), json.at("mrays_per_s").at("max"));
}

TEST_F(Trace, WritesWhetherRaysAreOccluded) {
  ASSERT_EQ(trace({"--query", "any"}).exit_code, 0);
  const std::vector<Hit> hits = read_hits();
  for (std::size_t i = 0; i < hits.size(); ++i) {
    EXPECT_EQ(hits[i].t, accelerator_.top().occluded(rays_[i]) ? 0.0F : std::numeric_limits<float>::infinity()) << i;
    EXPECT_EQ(hits[i].u, 0.0F);
    EXPECT_EQ(hits[i].primitive, kInvalidId);
    EXPECT_EQ(hits[i].instance, kInvalidId);
  }
}

TEST_F(Trace, TracesNoRaysAtAll) {
  write_rays(directory_ / "rays.npy", {});
  const CommandResult result = trace({});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(read_file(directory_ / "hits.npy"), HasSubstr("'shape': (0,)"));
}

TEST_F(Trace, QuietSaysNothing) {
  const CommandResult result = trace({"--quiet"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out + result.err, "");
}

TEST_F(Trace, MalformedRaysFail) {
  write_file(directory_ / "rays.npy", "nothing like an array");
  const CommandResult result = trace({});
  expect_failure(result, 1);
  EXPECT_THAT(result.err, HasSubstr("rays.npy"));
  EXPECT_EQ(directory_.entry_count(), 1U);
}

TEST_F(Trace, MissingRaysFail) {
  std::filesystem::remove(directory_ / "rays.npy");
  expect_failure(trace({}), 1);
}

TEST_F(Trace, UnwritableOutputsFailBeforeTheWork) {
  CommandSettings settings;
  settings.time_limit = 5.0;
  for (const char* option : {"--hits", "--json"}) {
    std::vector<std::string> arguments{"trace", "builtin:soup?triangles=20000000", "--rays", "rays.npy", option, "/nowhere/file"};
    if (std::string(option) == "--json") arguments.insert(arguments.end(), {"--hits", "hits.npy"});
    const CommandResult result = run_command(directory_, arguments, settings);
    expect_failure(result, 1);
    EXPECT_THAT(result.err, HasSubstr("/nowhere/file"));
    EXPECT_EQ(result.out, "");
  }
}

TEST_F(Trace, AFullDiskFailsAndIsSaid) {
  const CommandResult result = run_command(directory_, {"trace", kScene, "--rays", "rays.npy", "--hits", "/dev/full"});
  expect_failure(result, 1);
  EXPECT_THAT(result.err, HasSubstr("/dev/full"));
}

}  // namespace
}  // namespace grove::testing
