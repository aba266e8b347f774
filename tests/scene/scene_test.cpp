#include "grove/scene/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "grove/scene/load.h"
#include "scene/temporary_file.h"

namespace grove {
namespace {

using testing::HasSubstr;

// Two triangles in two parts, placed twice.
Scene two_instances() {
  Scene scene;
  scene.materials.resize(2);
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->add_part({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  mesh->add_part({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {5, 5, 5}}, {{0, 1, 2}});
  Object object;
  object.geometry = mesh;
  object.parts.resize(2);
  object.parts[1].material = 1;
  object.parts[1].uvs.resize(4);
  scene.objects.push_back(std::move(object));
  scene.instances.resize(2);
  Mat4 moved(1.0F);
  moved[3] = Vec4(10, 0, 0, 1);
  scene.instances[1].object_to_world = Transform(moved);
  return scene;
}

std::string problem_of(const Scene& scene) {
  return input_error_of([&] { scene.validate("file.x"); });
}

TEST(Scene, CountsAndBounds) {
  const Scene scene = two_instances();
  scene.validate("file.x");
  EXPECT_EQ(scene.primitive_count(), 4U);
  EXPECT_EQ(scene.stored_primitive_count(), 2U);
  const Box bounds = scene.bounds();
  EXPECT_NEAR(bounds.lower.x, 0.0F, 1e-4F);
  EXPECT_NEAR(bounds.upper.x, 11.0F, 1e-4F);
  // The lone vertex at 5 5 5 is part of nothing.
  EXPECT_NEAR(bounds.upper.z, 1.0F, 1e-4F);
}

TEST(Scene, BoundsLeaveOutInstancesThatCannotBeHit) {
  Scene scene = two_instances();
  scene.instances[1].object_to_world = Transform(Mat4(0.0F));
  EXPECT_NEAR(scene.bounds().upper.x, 1.0F, 1e-4F);
}

TEST(Scene, ValidateNamesWhatIsWrong) {
  Scene scene = two_instances();
  scene.objects[0].parts[1].material = 2;
  EXPECT_THAT(problem_of(scene), HasSubstr("file.x:object 0: names a material"));
  scene = two_instances();
  scene.objects[0].parts[1].uvs.resize(3);
  EXPECT_THAT(problem_of(scene), HasSubstr("for some vertices only"));
  scene = two_instances();
  scene.objects[0].parts.pop_back();
  EXPECT_THAT(problem_of(scene), HasSubstr("materials than parts"));
  scene = two_instances();
  scene.instances[1].object = 1;
  EXPECT_THAT(problem_of(scene), HasSubstr("instance 1"));
  scene = two_instances();
  scene.materials[1].roughness.texture = 0;
  EXPECT_THAT(problem_of(scene), HasSubstr("material 1: names a texture"));
  scene = two_instances();
  scene.materials[1].kind = MaterialKind::mix;
  scene.materials[1].mix_material[1] = 1;
  EXPECT_THAT(problem_of(scene), HasSubstr("material 1: mixes"));
  scene = two_instances();
  scene.textures.resize(1);
  scene.textures[0].operand[0] = 0;
  EXPECT_THAT(problem_of(scene), HasSubstr("texture 0"));
  scene.textures[0] = {};
  scene.textures[0].kind = TextureKind::image;
  scene.textures[0].image = 0;
  EXPECT_THAT(problem_of(scene), HasSubstr("texture 0: names an image"));
  auto image = std::make_shared<Image>();
  image->width = image->height = image->channels = 2;
  image->bytes.resize(7);
  scene.images.push_back(image);
  EXPECT_THAT(problem_of(scene), HasSubstr("image 0"));
  scene = two_instances();
  scene.environment.image = 3;
  EXPECT_THAT(problem_of(scene), HasSubstr("environment"));
}

TEST(Scene, ValidateWantsSomethingToHit) {
  Scene scene = two_instances();
  scene.instances.clear();
  EXPECT_THAT(problem_of(scene), HasSubstr("nothing renderable"));
  scene = two_instances();
  for (Instance& instance : scene.instances) instance.object_to_world = Transform(Mat4(0.0F));
  EXPECT_THAT(problem_of(scene), HasSubstr("nothing renderable"));
}

TEST(Scene, WarnsOnceForEachLine) {
  Scene scene;
  scene.warn("a");
  scene.warn("b");
  scene.warn("a");
  EXPECT_THAT(scene.warnings, testing::ElementsAre("a", "b"));
}

TEST(Camera, LooksAtItsTarget) {
  const Camera camera = look_at({3, 2, 1}, {3, 2, -4}, {0, 1, 0}, 0.5F);
  EXPECT_EQ(camera.camera_to_world * Vec4(0, 0, 0, 1), Vec4(3, 2, 1, 1));
  EXPECT_EQ(camera.camera_to_world * Vec4(0, 0, -5, 1), Vec4(3, 2, -4, 1));
  EXPECT_EQ(camera.camera_to_world * Vec4(1, 0, 0, 0), Vec4(1, 0, 0, 0));
  EXPECT_EQ(camera.focus_distance, 5.0F);
}

TEST(LoadScene, SaysWhyAPathCannotBeRead) {
  EXPECT_THAT(input_error_of([] { (void)load_scene("no/such/file.obj"); }), HasSubstr("no/such/file.obj: no such file"));
  const TemporaryFile file("scene.xyz", "x");
  EXPECT_THAT(input_error_of([&] { (void)load_scene(file.path().string()); }), HasSubstr(".gltf .glb .pbrt .obj .ply .ply.gz .stl"));
  EXPECT_THAT(input_error_of([&] { (void)load_scene(file.path().parent_path().string()); }), HasSubstr("is a directory"));
  EXPECT_THAT(input_error_of([] { (void)load_scene("/dev/null"); }), HasSubstr("not a regular file"));
  EXPECT_THROW((void)load_scene("builtin:"), UsageError);
}

TEST(LoadScene, TellsFormatsByTheEndingInAnyCase) {
  const TemporaryFile file("MODEL.Obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Scene scene = load_scene(file.path().string());
  EXPECT_EQ(scene.name, "MODEL.Obj");
  EXPECT_GT(scene.load_seconds, 0.0);
}

}  // namespace
}  // namespace grove
