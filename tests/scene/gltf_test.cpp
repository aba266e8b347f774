#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/gltf_fixture.h"

namespace grove {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Json = nlohmann::json;

TEST_F(Gltf, TheSameSceneFromBinaryFileAndDataUri) {
  file_.add_node({{"mesh", file_.add_triangle()}});
  const Scene binary = load();
  const Scene beside = load_gltf(file_.write_text(folder_, "my buffer.bin", "my%20buffer.bin"));
  // The 44 bytes of three points, three indices and padding, by hand: zeros but for the floats 1.0 (0000803f) and the indices.
  const std::string base64 = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIA";
  const Scene embedded = load_gltf(file_.write_text(folder_, "", "data:application/octet-stream;base64," + base64));
  for (const Scene* scene : {&binary, &beside, &embedded}) {
    EXPECT_THAT(vertices(*scene), ElementsAre(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)));
    EXPECT_THAT(triangles(*scene), ElementsAre(Triangle(0, 1, 2)));
    EXPECT_TRUE(scene->instances.at(0).object_to_world.is_identity());
    EXPECT_THAT(scene->warnings, IsEmpty());
  }
}

TEST_F(Gltf, ChildrenMoveWithTheirParents) {
  const int child = file_.add_child({{"mesh", file_.add_triangle()}, {"scale", {2, 3, 4}}});
  const double half = std::sqrt(0.5);
  // A quarter turn about z takes x to y.
  const int middle = file_.add_child({{"children", {child}}, {"rotation", {0, 0, half, half}}});
  file_.add_node({{"children", {middle}}, {"translation", {10, 20, 30}}});
  const std::vector<Vec3> moved = vertices(load());
  const std::vector<Vec3> expected = {{10, 20, 30}, {10, 22, 30}, {7, 20, 30}};
  ASSERT_EQ(moved.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(glm::distance(moved[i], expected[i]), 1e-5F) << i;
}

TEST_F(Gltf, MatricesAreColumnMajor) {
  file_.add_node({{"mesh", file_.add_triangle()}, {"matrix", {0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 5, 6, 7, 1}}});
  EXPECT_THAT(vertices(load()), ElementsAre(Vec3(5, 6, 7), Vec3(5, 7, 7), Vec3(5, 6, 8)));
}

TEST_F(Gltf, MeshesOfSeveralNodesAreInstancesAndTheRestIsOneObject) {
  const int shared = file_.add_triangle();
  const int single = file_.add_triangle();
  const int other = file_.add_triangle();
  file_.add_node({{"mesh", shared}, {"translation", {1, 0, 0}}, {"name", "left"}});
  file_.add_node({{"mesh", single}});
  file_.add_node({{"mesh", shared}, {"translation", {2, 0, 0}}});
  file_.add_node({{"mesh", other}, {"translation", {0, 0, 9}}});
  const Scene scene = load();
  ASSERT_EQ(scene.objects.size(), 2U);
  EXPECT_EQ(mesh(scene, 0).part_count(), 2U);
  EXPECT_EQ(vertices(scene, 0).at(3), Vec3(0, 0, 9));
  ASSERT_EQ(scene.instances.size(), 3U);
  EXPECT_TRUE(scene.instances[0].object_to_world.is_identity());
  EXPECT_EQ(scene.instances[1].name, "left");
  EXPECT_EQ(scene.instances[1].object, 1U);
  EXPECT_EQ(scene.instances[1].object_to_world.point(Vec3(0.0F)), Vec3(1, 0, 0));
  EXPECT_EQ(scene.instances[2].object_to_world.point(Vec3(0.0F)), Vec3(2, 0, 0));
  EXPECT_EQ(scene.primitive_count(), 4U);
  EXPECT_EQ(scene.stored_primitive_count(), 3U);
}

TEST_F(Gltf, GpuInstancing) {
  const int translations = file_.add(std::vector<Vec3>{{1, 0, 0}, {2, 0, 0}, {3, 0, 0}});
  const int scales = file_.add(std::vector<Vec3>{{1, 1, 1}, {2, 2, 2}, {3, 3, 3}});
  const Json attributes = {{"TRANSLATION", translations}, {"SCALE", scales}};
  file_.add_node({{"mesh", file_.add_triangle()},
                  {"translation", {0, 5, 0}},
                  {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", attributes}}}}}});
  const Scene scene = load();
  ASSERT_EQ(scene.instances.size(), 3U);
  EXPECT_EQ(scene.instances[2].object_to_world.point(Vec3(1, 0, 0)), Vec3(6, 5, 0));
}

TEST_F(Gltf, AReflectionKeepsTheFrontInFront) {
  const int mesh_id = file_.add_triangle();
  Json& attributes = file_.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["NORMAL"] = file_.add(std::vector<Vec3>(3, Vec3(0, 0, 1)));
  attributes["TANGENT"] = file_.add(std::vector<Vec4>(3, Vec4(1, 0, 0, 1)));
  file_.add_node({{"mesh", mesh_id}, {"scale", {-1, 1, 1}}});
  const Scene scene = load();
  EXPECT_THAT(triangles(scene), ElementsAre(Triangle(0, 2, 1)));
  const std::vector<Vec3> v = vertices(scene);
  EXPECT_GT(glm::cross(v[2] - v[0], v[1] - v[0]).z, 0.0F);
  EXPECT_EQ(scene.objects[0].parts[0].normals.at(0), Vec3(0, 0, 1));
  EXPECT_EQ(scene.objects[0].parts[0].tangents.at(0), Vec4(-1, 0, 0, -1));
}

TEST_F(Gltf, NormalsOfStretchedNodesStayPerpendicular) {
  const int mesh_id = file_.add_mesh({{"attributes",
                                       {{"POSITION", file_.add(std::vector<Vec3>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}})},
                                        {"NORMAL", file_.add(std::vector<Vec3>(3, Vec3(5, 5, 5)))}}}});
  file_.add_node({{"mesh", mesh_id}, {"scale", {1, 10, 1}}});
  const Scene scene = load();
  const std::vector<Vec3> v = vertices(scene);
  const Vec3 normal = scene.objects[0].parts[0].normals.at(0);
  EXPECT_NEAR(glm::dot(normal, v[1] - v[0]), 0.0F, 1e-5F);
  EXPECT_NEAR(glm::dot(normal, v[2] - v[0]), 0.0F, 1e-5F);
  EXPECT_NEAR(glm::length(normal), 1.0F, 1e-6F);
}

TEST_F(Gltf, NormalsWithoutDirectionTakeTheTriangles) {
  const int mesh_id = file_.add_triangle();
  file_.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = file_.add(std::vector<Vec3>(3, Vec3(0.0F)));
  file_.add_node({{"mesh", mesh_id}});
  EXPECT_EQ(load().objects[0].parts[0].normals.at(2), Vec3(0, 0, 1));
}

TEST_F(Gltf, StripsFansAndUnindexedLists) {
  const int position = file_.add(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 2, 0}});
  file_.add_node({{"mesh", file_.add_mesh({{"attributes", {{"POSITION", position}}}, {"mode", 5}})}});
  file_.add_node({{"mesh", file_.add_mesh({{"attributes", {{"POSITION", position}}}, {"mode", 6}})}});
  file_.add_node({{"mesh", file_.add_mesh({{"attributes", {{"POSITION", position}}}})}});
  file_.add_node({{"mesh", file_.add_mesh({{"attributes", {{"POSITION", position}}}, {"mode", 1}})}});
  const Scene scene = load();
  EXPECT_THAT(triangles(scene), ElementsAre(Triangle(0, 1, 2), Triangle(1, 3, 2), Triangle(2, 3, 4),  // strip
                                            Triangle(6, 7, 5), Triangle(7, 8, 5), Triangle(8, 9, 5),  // fan
                                            Triangle(10, 11, 12)));                                   // list with two vertices to spare
  EXPECT_THAT(scene.warnings, Contains(HasSubstr("points and lines are left out, such as meshes[3].primitives[0]")));
  EXPECT_THAT(scene.warnings, Contains(HasSubstr("make no whole triangle")));
}

TEST_F(Gltf, SparseAccessorsWithAndWithoutABase) {
  const int ids = file_.add_view(std::vector<std::uint8_t>{1, 2});
  const int values = file_.add_view(std::vector<Vec3>{{7, 0, 0}, {0, 7, 0}});
  const Json sparse = {{"count", 2}, {"indices", {{"bufferView", ids}, {"componentType", 5121}}}, {"values", {{"bufferView", values}}}};
  file_.json["accessors"].push_back({{"componentType", 5126}, {"count", 3}, {"type", "VEC3"}, {"sparse", sparse}});
  file_.add_node({{"mesh", file_.add_mesh({{"attributes", {{"POSITION", 0}}}})}});
  const int base = file_.add(std::vector<Vec3>{{1, 1, 1}, {2, 2, 2}, {3, 3, 3}});
  file_.json["accessors"][static_cast<std::size_t>(base)]["sparse"] = sparse;
  file_.add_node({{"mesh", file_.add_mesh({{"attributes", {{"POSITION", base}}}})}});
  EXPECT_THAT(vertices(load()), ElementsAre(Vec3(0, 0, 0), Vec3(7, 0, 0), Vec3(0, 7, 0), Vec3(1, 1, 1), Vec3(7, 0, 0), Vec3(0, 7, 0)));
}

TEST_F(Gltf, NormalisedIntegersAndStrides) {
  const int mesh_id = file_.add_triangle();
  Json& attributes = file_.json["meshes"][0]["primitives"][0]["attributes"];
  const int uvs = file_.add_accessor(file_.add_view(std::vector<std::uint16_t>{0, 65535, 65535, 0, 0, 0}), 5123, 3, "VEC2");
  file_.json["accessors"][static_cast<std::size_t>(uvs)]["normalized"] = true;
  const int colour_view = file_.add_view(std::vector<std::uint8_t>{255, 0, 51, 9, 0, 255, 0, 9, 0, 0, 255, 9});
  file_.json["bufferViews"][static_cast<std::size_t>(colour_view)]["byteStride"] = 4;
  const int colours = file_.add_accessor(colour_view, 5121, 3, "VEC3");
  file_.json["accessors"][static_cast<std::size_t>(colours)]["normalized"] = true;
  attributes["TEXCOORD_0"] = uvs;
  attributes["COLOR_0"] = colours;
  file_.add_node({{"mesh", mesh_id}});
  const Scene scene = load();
  const Part& part = scene.objects[0].parts[0];
  EXPECT_THAT(part.uvs, ElementsAre(Vec2(0, 1), Vec2(1, 0), Vec2(0, 0)));
  EXPECT_THAT(part.colours, ElementsAre(Vec4(1, 0, 0.2F, 1), Vec4(0, 1, 0, 1), Vec4(0, 0, 1, 1)));
}

TEST_F(Gltf, OnlyTheUsedPartOfASharedArrayIsKept) {
  std::vector<Vec3> points(1000);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {static_cast<float>(i), static_cast<float>(i * i), 0.0F};
  const int position = file_.add(points);
  const int indices = file_.add(std::vector<std::uint16_t>{900, 10, 500});
  file_.add_node({{"mesh", file_.add_mesh({{"attributes", {{"POSITION", position}, {"NORMAL", position}}}, {"indices", indices}})}});
  const Scene scene = load();
  EXPECT_THAT(vertices(scene), ElementsAre(points[10], points[500], points[900]));
  EXPECT_THAT(triangles(scene), ElementsAre(Triangle(2, 0, 1)));
  EXPECT_EQ(scene.objects[0].parts[0].normals.size(), 3U);
}

TEST_F(Gltf, SkinsShowTheirRestPose) {
  const int mesh_id = file_.add_triangle();
  Json& attributes = file_.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] =
      file_.add_accessor(file_.add_view(std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}), 5121, 3, "VEC4");
  attributes["WEIGHTS_0"] = file_.add(std::vector<Vec4>{{1, 0, 0, 0}, {1, 0, 0, 0}, {0.5F, 0.5F, 0, 0}});
  const int tip = file_.add_child({{"translation", {0, 10, 0}}});
  const int root = file_.add_node({{"translation", {100, 0, 0}}, {"children", {tip}}});
  Mat4 tip_bind(1.0F);
  tip_bind[3] = {0, -4, 0, 1};
  file_.json["skins"] = {{{"joints", {root, tip}}, {"inverseBindMatrices", file_.add(std::vector<Mat4>{Mat4(1.0F), tip_bind})}}};
  // The mesh node's own transform must not matter.
  file_.add_node({{"mesh", mesh_id}, {"skin", 0}, {"translation", {0, 0, 555}}});
  EXPECT_THAT(vertices(load()), ElementsAre(Vec3(100, 0, 0), Vec3(101, 6, 0), Vec3(100, 4, 0)));
}

TEST_F(Gltf, MorphTargetsTakeTheMeshesOrTheNodesWeights) {
  const int mesh_id = file_.add_triangle();
  const int deltas = file_.add(std::vector<Vec3>{{0, 0, 1}, {0, 0, 2}, {0, 0, 3}});
  file_.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", deltas}}};
  file_.json["meshes"][0]["weights"] = {0.5};
  file_.add_node({{"mesh", mesh_id}});
  file_.add_node({{"mesh", mesh_id}, {"weights", {2.0}}});
  const std::vector<Vec3> v = vertices(load());
  EXPECT_EQ(v.at(1), Vec3(1, 0, 1));
  EXPECT_EQ(v.at(4), Vec3(1, 0, 4));
}

TEST_F(Gltf, ExtensionsThatAreNotKnown) {
  file_.add_node({{"mesh", file_.add_triangle()}});
  file_.json["extensionsUsed"] = {"KHR_lights_punctual", "EXT_teapot", "KHR_materials_iridescence"};
  EXPECT_THAT(load().warnings, ElementsAre(HasSubstr("EXT_teapot"), HasSubstr("KHR_materials_iridescence")));
  file_.json["extensionsRequired"] = {"EXT_teapot"};
  EXPECT_THAT(error(), HasSubstr("extensionsRequired[0]: EXT_teapot is required but not supported"));
  file_.json["extensionsRequired"] = {"KHR_materials_iridescence"};
  EXPECT_THAT(error(), HasSubstr("KHR_materials_iridescence is required but not supported"));
}

TEST_F(Gltf, AFileWithoutScenesShowsItsRoots) {
  file_.add_child({{"mesh", file_.add_triangle()}});
  file_.json.erase("scenes");
  file_.json.erase("scene");
  EXPECT_EQ(load().primitive_count(), 1U);
}

class SharedGltf : public ::testing::Test {
 protected:
  void SetUp() override {
    scenes_ = std::filesystem::path(GROVE_SOURCE_DIR) / ".." / "shared" / "scenes";
    if (!std::filesystem::exists(scenes_)) GTEST_SKIP() << "no ../shared/scenes beside the source tree";
  }
  std::filesystem::path scenes_;
};

TEST_F(SharedGltf, FlightHelmet) {
  const Scene scene = load_gltf(scenes_ / "flight-helmet/FlightHelmet.gltf");
  EXPECT_EQ(scene.primitive_count(), 94722U);
  EXPECT_EQ(scene.objects.size(), 1U);
  EXPECT_EQ(scene.objects[0].parts.size(), 6U);
  EXPECT_EQ(scene.images.size(), 15U);
  EXPECT_THAT(scene.warnings, IsEmpty());
}

TEST_F(SharedGltf, PineTree) {
  const Scene scene = load_gltf(scenes_ / "pine-tree/scene.gltf");
  EXPECT_EQ(scene.primitive_count(), 1650U);
  EXPECT_EQ(scene.materials.at(1).alpha_mode, AlphaMode::blend);
}

TEST_F(SharedGltf, ForestOfInstances) {
  const Scene scene = load_gltf(scenes_ / "pine-tree/forest.gltf");
  EXPECT_EQ(scene.stored_primitive_count(), 1650U);
  EXPECT_EQ(scene.instances.size(), 2U * 576U);
  EXPECT_EQ(scene.primitive_count(), 950400U);
}

TEST_F(SharedGltf, FoxStandsOnTheGround) {
  const Scene scene = load_gltf(scenes_ / "animated/Fox.glb");
  EXPECT_EQ(scene.primitive_count(), 576U);
  const Box bounds = scene.bounds();
  // Known to be about 25 wide, 79 high and 154 long, nose along +z, paws at 0.
  EXPECT_NEAR(bounds.lower.y, 0.0F, 2.0F);
  EXPECT_NEAR(bounds.extent().x, 25.0F, 5.0F);
  EXPECT_NEAR(bounds.extent().y, 79.0F, 5.0F);
  EXPECT_NEAR(bounds.extent().z, 154.0F, 10.0F);
}

TEST_F(SharedGltf, MorphStressTest) {
  const Scene scene = load_gltf(scenes_ / "animated/MorphStressTest.gltf");
  EXPECT_EQ(scene.primitive_count(), 2412U);
  EXPECT_EQ(scene.objects[0].parts.size(), 2U);
}

}  // namespace
}  // namespace grove
