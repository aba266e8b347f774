// Animations of glTF files: keyframes against values worked out by hand, what they move, what is said to have changed, and files that are wrong.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "grove/scene/animation/keyframes.h"
#include "grove/scene/load_animated.h"
#include "scene/gltf_fixture.h"

namespace grove {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;
using Json = nlohmann::json;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

double sample_one(const KeyframeTrack& track, double time) {
  std::array<double, 1> value{};
  track.sample(time, value);
  return value[0];
}

TEST(KeyframeTrack, StepsAndLines) {
  KeyframeTrack track{Interpolation::step, false, 1, {1, 2, 4}, {10, 20, 50}};
  EXPECT_EQ(sample_one(track, 0.0), 10.0);
  EXPECT_EQ(sample_one(track, 1.999), 10.0);
  EXPECT_EQ(sample_one(track, 2.0), 20.0);
  EXPECT_EQ(sample_one(track, 9.0), 50.0);
  track.interpolation = Interpolation::linear;
  EXPECT_EQ(sample_one(track, 0.0), 10.0);
  EXPECT_EQ(sample_one(track, 1.25), 12.5);
  EXPECT_EQ(sample_one(track, 3.0), 35.0);
  EXPECT_EQ(sample_one(track, 9.0), 50.0);
}

TEST(KeyframeTrack, CubicSplines) {
  // Tangent in, value, tangent out; two seconds apart, so that tangents count twice.
  const KeyframeTrack track{Interpolation::cubic_spline, false, 1, {0, 2}, {7, 1, 3, -5, 2, 7}};
  EXPECT_EQ(sample_one(track, 0.0), 1.0);
  EXPECT_EQ(sample_one(track, 2.0), 2.0);
  // s = 1/4: values (27/32) 1 + (5/32) 2, tangents 2 (9/64) 3 + 2 (-3/64) (-5).
  EXPECT_NEAR(sample_one(track, 0.5), 27.0 / 32 + 10.0 / 32 + 54.0 / 64 + 30.0 / 64, 1e-12);
}

TEST(KeyframeTrack, RotationsTakeTheShorterArc) {
  // A quarter turn about z, written with the sign that makes the long way round.
  const float half = std::sqrt(0.5F);
  const KeyframeTrack track{Interpolation::linear, true, 4, {0, 1}, {0, 0, 0, 1, 0, 0, -half, -half}};
  std::array<double, 4> q{};
  track.sample(1.0 / 3, q);
  // A third of it is 30 degrees, whose half angle is 15.
  const double angle = 15.0 * 3.14159265358979 / 180.0;
  EXPECT_NEAR(q[2], std::sin(angle), 1e-7);
  EXPECT_NEAR(q[3], std::cos(angle), 1e-7);
  EXPECT_EQ(q[0], 0.0);
}

class GltfAnimation : public Gltf {
 protected:
  AnimatedScene load_animated(const std::string& choice = "") const {
    std::ofstream(folder_ / "scene.glb", std::ios::binary) << file_.glb();
    return load_animated_scene((folder_ / "scene.glb").string(), choice);
  }

  /// Adds a channel to the first animation.
  void animate(int node, const char* path, const std::vector<float>& times, int output, const char* interpolation = "LINEAR") {
    Json& animation = file_.json["animations"][0];
    animation["samplers"].push_back({{"input", file_.add(times)}, {"output", output}, {"interpolation", interpolation}});
    animation["channels"].push_back({{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
  }

  /// A triangle whose one node moves by x = 2 a second, for two seconds.
  int add_moving_triangle() {
    const int node = file_.add_node({{"mesh", file_.add_triangle()}, {"name", "mover"}});
    animate(node, "translation", {0, 2}, file_.add(std::vector<Vec3>{{0, 0, 0}, {4, 0, 0}}));
    return node;
  }

  static Vec3 place(const AnimatedScene& scene, std::size_t instance) {
    return Vec3(scene.scene().instances.at(instance).object_to_world.matrix()[3]);
  }
};

TEST_F(GltfAnimation, MovesInstancesAndSaysWhich) {
  const int mover = add_moving_triangle();
  const int still = file_.add_triangle();
  file_.add_node({{"mesh", still}});
  const int child = file_.add_child({{"mesh", still}, {"translation", {0, 1, 0}}});
  file_.json["nodes"][static_cast<std::size_t>(mover)]["children"] = {child};
  AnimatedScene scene = load_animated();
  // The mesh of two nodes is an object of theirs anyway; nothing is left to stand in the world.
  ASSERT_EQ(scene.scene().instances.size(), 3U);
  EXPECT_EQ(scene.animation()->end, 2.0);
  EXPECT_THAT(scene.move_to(0.0).instances, UnorderedElementsAre(0, 1));
  EXPECT_THAT(scene.move_to(0.0).instances, IsEmpty());
  const SceneChanges changes = scene.move_to(0.75);
  EXPECT_THAT(changes.instances, UnorderedElementsAre(0, 1));
  EXPECT_THAT(changes.objects, IsEmpty());
  EXPECT_FALSE(changes.cameras);
  EXPECT_EQ(place(scene, 0), Vec3(1.5F, 0, 0));
  EXPECT_EQ(place(scene, 1), Vec3(1.5F, 1, 0));
  EXPECT_EQ(place(scene, 2), Vec3(0, 0, 0));
  EXPECT_TRUE(scene.move_to(2.0).has_geometry());
  EXPECT_FALSE(scene.move_to(7.0).has_geometry()) << "behind the last keyframe all stays";
  // Without its animation it is one object, where the file has it.
  const Scene resting = load();
  EXPECT_EQ(resting.objects.size(), 2U);
  EXPECT_EQ(vertices(resting).at(1), Vec3(1, 0, 0));
}

TEST_F(GltfAnimation, BendsAStripOfTwoJoints) {
  const int position = file_.add(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}});
  const int normal = file_.add(std::vector<Vec3>(3, Vec3(0, 0, 1)));
  const int joints = file_.add_accessor(file_.add_view(std::vector<std::uint8_t>{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}), 5121, 3, "VEC4");
  // The last is to be scaled to (0.25, 0.75).
  const int weights = file_.add(std::vector<Vec4>{{1, 0, 0, 0}, {1, 0, 0, 0}, {0.5F, 1.5F, 0, 0}});
  const int mesh_id =
      file_.add_mesh({{"attributes", {{"POSITION", position}, {"NORMAL", normal}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}}});
  const int tip = file_.add_child({{"translation", {0, 1, 0}}});
  const int root = file_.add_node({{"children", {tip}}});
  Mat4 tip_bind(1.0F);
  tip_bind[3] = {0, -1, 0, 1};
  file_.json["skins"] = {{{"joints", {root, tip}}, {"inverseBindMatrices", file_.add(std::vector<Mat4>{Mat4(1.0F), tip_bind})}}};
  file_.add_node({{"mesh", mesh_id}, {"skin", 0}, {"translation", {0, 0, 555}}});
  const float half = std::sqrt(0.5F);
  // The tip turns by a quarter about x within a second: y becomes z.
  animate(tip, "rotation", {0, 1}, file_.add(std::vector<Vec4>{{0, 0, 0, 1}, {half, 0, 0, half}}));

  AnimatedScene scene = load_animated();
  EXPECT_THAT(scene.scene().warnings, Contains(HasSubstr("do not sum to 1 are scaled until they do, such as in meshes[0].primitives[0]")));
  EXPECT_THAT(scene.move_to(0.0).objects, ElementsAre(0));
  EXPECT_EQ(vertices(scene.scene())[2], Vec3(0, 2, 0));
  EXPECT_THAT(scene.move_to(1.0).objects, ElementsAre(0));
  // A quarter of (0, 2, 0) and three quarters of (0, 1, 1).
  const Vec3 bent = vertices(scene.scene())[2];
  EXPECT_NEAR(bent.y, 1.25F, 1e-6F);
  EXPECT_NEAR(bent.z, 0.75F, 1e-6F);
  EXPECT_EQ(vertices(scene.scene())[1], Vec3(1, 0, 0));
  // The normal turns with the blended matrix: cofactors of columns (0, 1/4, 3/4) and (0, -3/4, 1/4) take z to (0, -3/4, 1/4).
  const Vec3 turned = scene.scene().objects[0].parts[0].normals[2];
  EXPECT_NEAR(turned.y, -0.75F / std::sqrt(0.625F), 1e-6F);
  EXPECT_NEAR(turned.z, 0.25F / std::sqrt(0.625F), 1e-6F);
  EXPECT_FALSE(scene.move_to(3.0).has_geometry());
  EXPECT_THAT(scene.move_to(0.5).objects, ElementsAre(0));
}

TEST_F(GltfAnimation, MorphsAndMovesAtOnce) {
  const int mesh_id = file_.add_triangle();
  const int up = file_.add(std::vector<Vec3>{{0, 0, 1}, {0, 0, 2}, {0, 0, 3}});
  const int right = file_.add(std::vector<Vec3>{{1, 0, 0}, {1, 0, 0}, {1, 0, 0}});
  file_.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", up}}, {{"POSITION", right}}};
  const int node = file_.add_node({{"mesh", mesh_id}});
  animate(node, "weights", {0, 1}, file_.add(std::vector<float>{0, 0, 1, 0.5F}));
  animate(node, "translation", {0, 2}, file_.add(std::vector<Vec3>{{0, 0, 0}, {0, 8, 0}}), "STEP");
  AnimatedScene scene = load_animated("0");
  scene.move_to(0.0);
  SceneChanges changes = scene.move_to(0.5);
  EXPECT_THAT(changes.objects, ElementsAre(0));
  EXPECT_THAT(changes.instances, IsEmpty());
  EXPECT_THAT(vertices(scene.scene()), ElementsAre(Vec3(0.25F, 0, 0.5F), Vec3(1.25F, 0, 1), Vec3(0.25F, 1, 1.5F)));
  changes = scene.move_to(2.0);
  EXPECT_THAT(changes.instances, ElementsAre(0));
  EXPECT_EQ(place(scene, 0), Vec3(0, 8, 0));
}

TEST_F(GltfAnimation, CamerasAndLightsFollowTheirNodes) {
  file_.add_node({{"mesh", file_.add_triangle()}});
  file_.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1.0}}}, {"name", "eye"}}};
  file_.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
  const int node = file_.add_node({{"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  animate(node, "translation", {0, 1}, file_.add(std::vector<Vec3>{{0, 0, 0}, {0, 0, 6}}));
  animate(node, "scale", {0, 1}, file_.add(std::vector<Vec3>{{1, 1, 1}, {0, 0, 0}}));
  AnimatedScene scene = load_animated();
  scene.move_to(0.0);
  const SceneChanges changes = scene.move_to(0.5);
  EXPECT_TRUE(changes.cameras);
  EXPECT_TRUE(changes.lights);
  EXPECT_FALSE(changes.has_geometry());
  EXPECT_EQ(Vec3(scene.scene().cameras[0].camera_to_world[3]), Vec3(0, 0, 3));
  EXPECT_EQ(scene.scene().lights[0].position, Vec3(0, 0, 3));
  // Scaled to nothing, the camera has no direction left and stays; a point light needs none.
  scene.move_to(1.0);
  EXPECT_EQ(Vec3(scene.scene().cameras[0].camera_to_world[3]), Vec3(0, 0, 3));
  EXPECT_EQ(scene.scene().lights[0].position, Vec3(0, 0, 6));
}

TEST_F(GltfAnimation, NodesMayVanish) {
  const int node = add_moving_triangle();
  animate(node, "scale", {0, 1, 2}, file_.add(std::vector<Vec3>{{1, 1, 1}, {0, 0, 0}, {1, 1, 1}}));
  AnimatedScene scene = load_animated();
  scene.move_to(1.0);
  EXPECT_FALSE(scene.scene().instances[0].object_to_world.is_invertible());
  scene.move_to(2.0);
  EXPECT_TRUE(scene.scene().instances[0].object_to_world.is_invertible());
}

TEST_F(GltfAnimation, IsChosenByNameOrNumber) {
  const int node = add_moving_triangle();
  Json second = file_.json["animations"][0];
  second["name"] = "up";
  second["samplers"][0]["output"] = file_.add(std::vector<Vec3>{{0, 0, 0}, {0, 9, 0}});
  file_.json["animations"].push_back(second);
  for (const char* choice : {"up", "1"}) {
    AnimatedScene scene = load_animated(choice);
    scene.move_to(2.0);
    EXPECT_EQ(place(scene, 0), Vec3(0, 9, 0)) << choice << " of node " << node;
  }
  try {
    (void)load_animated("down");
    ADD_FAILURE() << "there is no such animation";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("has no animation 'down'; there are 0, 1 'up'"));
  }
  EXPECT_THROW((void)load_animated_scene("builtin:cornell", "0"), UsageError);
  EXPECT_FALSE(load_animated_scene("builtin:cornell", "").animation());
}

TEST_F(GltfAnimation, BrokenKeyframesAreMended) {
  const int node = file_.add_node({{"mesh", file_.add_triangle()}});
  // In order and usable: 0 s at x = 0, 1 s at x = 2 (the later of two), 2 s at x = 8.
  animate(node, "translation", {2, kNan, 0, 1, 1, 3},
          file_.add(std::vector<Vec3>{{8, 0, 0}, {1, 1, 1}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {kNan, 0, 0}, {5, 5, 5}}));
  AnimatedScene scene = load_animated();
  for (const char* warning : {"not finite are left out, such as animations[0].samplers[0]", "do not ascend are sorted",
                              "same time the last", "more times than values"}) {
    EXPECT_THAT(scene.scene().warnings, Contains(HasSubstr(warning)));
  }
  scene.move_to(0.5);
  EXPECT_EQ(place(scene, 0), Vec3(1, 0, 0));
  scene.move_to(1.5);
  EXPECT_EQ(place(scene, 0), Vec3(5, 0, 0));
  EXPECT_EQ(scene.animation()->end, 2.0);
}

TEST_F(GltfAnimation, BrokenChannelsAreLeftOut) {
  const int node = add_moving_triangle();
  const int fixed = file_.add_node({{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}});
  const int values = file_.add(std::vector<Vec3>(2, Vec3(7)));
  animate(99, "translation", {0, 1}, values);
  animate(node, "colour", {0, 1}, values);
  animate(fixed, "translation", {0, 1}, values);
  animate(node, "scale", {kNan, kNan}, values);
  animate(node, "scale", {0, 1}, values);
  animate(node, "scale", {0, 1}, values);
  Json& animation = file_.json["animations"][0];
  animation["samplers"][5].erase("input");
  animation["channels"][6]["sampler"] = 77;
  AnimatedScene scene = load_animated();
  EXPECT_EQ(scene.animation()->channels.size(), 1U);
  for (const char* warning :
       {"to nodes that are not there are left out, such as animations[0].channels[1].target", "of what is not translation",
        "nodes that have a matrix", "without a usable keyframe", "without times or values", "without a sampler"}) {
    EXPECT_THAT(scene.scene().warnings, Contains(HasSubstr(warning)));
  }
}

TEST_F(GltfAnimation, BrokenSkinsAreMended) {
  const int mesh_id = file_.add_triangle();
  Json& attributes = file_.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] =
      file_.add_accessor(file_.add_view(std::vector<std::uint8_t>{0, 0, 0, 0, 0, 4, 0, 0, 9, 0, 0, 0}), 5121, 3, "VEC4");
  attributes["WEIGHTS_0"] = file_.add(std::vector<Vec4>{{1, kNan, -1, 0}, {0.5F, 0.5F, 0, 0}, {1, 0, 0, 0}});
  const int joint = file_.add_node({{"translation", {3, 0, 0}}});
  file_.json["skins"] = {{{"joints", {joint}}}};
  file_.add_node({{"mesh", mesh_id}, {"skin", 0}});
  const Scene scene = load();
  EXPECT_THAT(scene.warnings,
              Contains(HasSubstr("joint numbers that a skin does not have are left out, such as in meshes[0].primitives[0]")));
  EXPECT_THAT(scene.warnings, Contains(HasSubstr("negative or not finite are left out")));
  EXPECT_THAT(vertices(scene), ElementsAre(Vec3(3, 0, 0), Vec3(4, 0, 0), Vec3(3, 1, 0)));
}

TEST(BuiltinAnimation, ScenesWithATimeMove) {
  AnimatedScene scene = load_animated_scene("builtin:twist?size=2", "");
  EXPECT_THAT(scene.move_to(0.0).objects, ElementsAre(0));
  EXPECT_FALSE(scene.move_to(0.0).has_geometry());
  EXPECT_THAT(scene.move_to(0.5).objects, ElementsAre(0));
  const auto vertices_of = [](const Scene& s) { return std::get<std::shared_ptr<TriangleMesh>>(s.objects.at(0).geometry)->vertices(); };
  EXPECT_TRUE(std::ranges::equal(vertices_of(scene.scene()), vertices_of(load_scene("builtin:twist?size=2&time=0.5"))));
  EXPECT_FALSE(scene.move_to(1.0).objects.empty());
  EXPECT_FALSE(scene.move_to(8.0).has_geometry());
  EXPECT_FALSE(load_animated_scene("builtin:twist?size=2&time=0.5", "").animation());
}

TEST(SharedAnimation, FoxAndMorphStressTestPlay) {
  const std::filesystem::path folder = std::filesystem::path(GROVE_SOURCE_DIR) / "../shared/scenes/animated";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no ../shared/scenes beside the source tree";
  for (const auto& [file, animation, end] :
       {std::tuple("Fox.glb", "Run", 1.158F), std::tuple("Fox.glb", "2", 1.158F), std::tuple("MorphStressTest.gltf", "TheWave", 1.958F)}) {
    AnimatedScene scene = load_animated_scene((folder / file).string(), animation);
    EXPECT_THAT(scene.scene().warnings, IsEmpty()) << file;
    ASSERT_TRUE(scene.animation());
    EXPECT_NEAR(scene.animation()->end, end, 0.001);
    const Box resting = scene.scene().bounds();
    for (const double time : {0.0, 0.3, 0.6}) {
      EXPECT_EQ(scene.move_to(time).objects.size(), 1U);
      const Box bounds = scene.scene().bounds();
      EXPECT_FALSE(bounds.is_empty());
      // It moves, and does not fly to pieces.
      EXPECT_LT(glm::length(bounds.extent()), 2.0F * glm::length(resting.extent()));
    }
    EXPECT_FALSE(scene.move_to(0.6).has_geometry());
  }
}

}  // namespace
}  // namespace grove
