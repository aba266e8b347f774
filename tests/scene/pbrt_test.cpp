#include "scene/pbrt_file.h"

// Transforms, blocks, object instances, the camera and whole scenes.

namespace grove {
namespace {

Vec3 winding_normal(const TriangleMesh& mesh, std::size_t i) {
  const Triangle t = mesh.triangles()[i];
  const auto v = mesh.vertices();
  return glm::normalize(glm::cross(v[t.y] - v[t.x], v[t.z] - v[t.x]));
}

TEST_F(PbrtTest, TransformsApplyToWhatFollowsInnermostLast) {
  // (1, 0, 0) is scaled to (2, 0, 0), turned to (0, 2, 0), moved to (1, 4, 3).
  const Scene scene = load("WorldBegin Translate 1 2 3 Rotate 90 0 0 1 Scale 2 2 2\n" + std::string(kTriangle));
  expect_near(mesh(scene).vertices()[0], {1, 2, 3});
  expect_near(mesh(scene).vertices()[1], {1, 4, 3});
  expect_near(mesh(scene).vertices()[2], {-1, 2, 3});
}

TEST_F(PbrtTest, MatricesAreReadColumnByColumn) {
  const Scene scene = load(
      "WorldBegin Scale 9 9 9 Transform [ 0 1 0 0  -1 0 0 0  0 0 1 0  5 6 7 1 ]\n"
      "ConcatTransform [ 2 0 0 0  0 2 0 0  0 0 2 0  0 0 0 1 ]\n" +
      std::string(kTriangle));
  expect_near(mesh(scene).vertices()[0], {5, 6, 7});
  expect_near(mesh(scene).vertices()[1], {5, 8, 7});
  expect_near(mesh(scene).vertices()[2], {3, 6, 7});
}

TEST_F(PbrtTest, IdentityAndCoordinateSystems) {
  const Scene scene = load("WorldBegin Translate 1 0 0 CoordinateSystem \"a b\" Identity Translate 0 5 0 CoordSysTransform \"a b\"\n" +
                           std::string(kTriangle) + "Identity\n" + std::string(kTriangle));
  expect_near(mesh(scene).vertices()[0], {1, 0, 0});
  expect_near(mesh(scene).vertices()[3], {0, 0, 0});
}

TEST_F(PbrtTest, LookAtIsLeftHanded) {
  const Scene scene = load("LookAt 1 2 5  1 2 0  0 1 0\nCamera \"perspective\" \"float fov\" 40\nWorldBegin\n" + std::string(kTriangle));
  ASSERT_EQ(scene.cameras.size(), 1U);
  const Camera& camera = scene.cameras[0];
  expect_near(Vec3(camera.camera_to_world * Vec4(0, 0, 0, 1)), {1, 2, 5});
  expect_near(Vec3(camera.camera_to_world * Vec4(0, 0, -1, 0)), {0, 0, -1});
  expect_near(Vec3(camera.camera_to_world * Vec4(0, 1, 0, 0)), {0, 1, 0});
  // Right in the picture is up x forward = (0, 1, 0) x (0, 0, -1) = (-1, 0, 0).
  expect_near(Vec3(camera.camera_to_world * Vec4(1, 0, 0, 0)), {-1, 0, 0});
  EXPECT_NEAR(camera.field_of_view, 40.0F * kPi / 180.0F, 1e-6F);
  EXPECT_EQ(camera.axis, FieldOfViewAxis::smaller);
  EXPECT_EQ(camera.lens_radius, 0.0F);
}

TEST_F(PbrtTest, ScaleMirrorsTheCameraAndLookAtOfTheSideAxes) {
  // Camera space (x, y, z) is (-x, y, z) after LookAt's inverse: right is +x of the world again.
  const Scene scene = load("Scale -1 1 1 LookAt 0 0 5  0 0 0  0 1 0\nCamera \"perspective\"\nWorldBegin\n" + std::string(kTriangle));
  const Mat4& m = scene.cameras.at(0).camera_to_world;
  expect_near(Vec3(m * Vec4(1, 0, 0, 0)), {1, 0, 0});
  expect_near(Vec3(m * Vec4(0, 0, -1, 0)), {0, 0, -1});
  expect_near(Vec3(m * Vec4(0, 0, 0, 1)), {0, 0, 5});
  EXPECT_NEAR(scene.cameras[0].field_of_view, kPi / 2, 1e-6F);
}

TEST_F(PbrtTest, LookAtFromTheSide) {
  // Eye on +x looking at the origin: forward (-1, 0, 0), right = (0, 0, 1) x (-1, 0, 0) = (0, -1, 0), up stays z.
  const Scene scene = load("LookAt 3 0 0  0 0 0  0 0 2\nCamera \"perspective\"\nWorldBegin\n" + std::string(kTriangle));
  const Mat4& m = scene.cameras.at(0).camera_to_world;
  expect_near(Vec3(m * Vec4(0, 0, -1, 0)), {-1, 0, 0});
  expect_near(Vec3(m * Vec4(1, 0, 0, 0)), {0, -1, 0});
  expect_near(Vec3(m * Vec4(0, 1, 0, 0)), {0, 0, 1});
}

TEST_F(PbrtTest, CameraScaleMovesIntoTheLens) {
  // World to camera shrinks by 2, so that camera lengths are twice as long in the world.
  const Scene scene = load(
      "Scale .5 .5 .5 Translate 0 0 -4 Camera \"perspective\" \"float lensradius\" .1 \"float focaldistance\" [ 3 ]\n"
      "Film \"rgb\" \"integer xresolution\" [ 320 ] \"integer yresolution\" 200\nWorldBegin\n" +
      std::string(kTriangle));
  const Camera& camera = scene.cameras.at(0);
  EXPECT_NEAR(camera.lens_radius, 0.2F, 1e-6F);
  EXPECT_NEAR(camera.focus_distance, 6.0F, 1e-5F);
  expect_near(Vec3(camera.camera_to_world * Vec4(0, 0, 0, 1)), {0, 0, 4});
  expect_near(Vec3(camera.camera_to_world * Vec4(0, 0, -1, 0)), {0, 0, 1});
  EXPECT_EQ(scene.film.width, 320U);
  EXPECT_EQ(scene.film.height, 200U);
}

TEST_F(PbrtTest, CameraCoordinateSystemPlacesThingsInFrontOfIt) {
  const Scene scene = load("Translate 0 0 -7 Camera \"perspective\" WorldBegin CoordSysTransform \"camera\"\n" + std::string(kTriangle));
  expect_near(mesh(scene).vertices()[0], {0, 0, 7});
}

TEST_F(PbrtTest, FilmSaysNothingWhereThereIsNone) {
  const Scene without = load_world("");
  EXPECT_EQ(without.film.width, 0U);
  EXPECT_TRUE(without.cameras.empty());
  const Scene bare = load("Film \"rgb\"\nWorldBegin\n" + std::string(kTriangle));
  EXPECT_EQ(bare.film.width, 1280U);
  EXPECT_EQ(bare.film.height, 720U);
}

TEST_F(PbrtTest, BlocksBringBackWhatWas) {
  const Scene scene = load("WorldBegin AttributeBegin Translate 5 0 0 Material \"dielectric\" AttributeEnd\n" + std::string(kTriangle) +
                           "TransformBegin Translate 0 5 0 Material \"conductor\" TransformEnd\n" + std::string(kTriangle));
  expect_near(mesh(scene).vertices()[0], {0, 0, 0});
  expect_near(mesh(scene).vertices()[3], {0, 0, 0});
  EXPECT_EQ(material(scene, 0).kind, MaterialKind::diffuse);
  // TransformEnd brings back the transform only.
  EXPECT_EQ(material(scene, 1).kind, MaterialKind::conductor);
}

TEST_F(PbrtTest, WindingFollowsThePlacedNormal) {
  const std::string t(kTriangle);
  const Scene scene = load("WorldBegin\n" + t + "AttributeBegin ReverseOrientation\n" + t + "AttributeEnd AttributeBegin Scale -1 1 1\n" +
                           t + "AttributeEnd AttributeBegin Scale 1 1 -1\n" + t + "AttributeEnd\n");
  expect_near(winding_normal(mesh(scene), 0), {0, 0, 1});
  expect_near(winding_normal(mesh(scene), 1), {0, 0, -1});
  // Mirrored in x the outside is still +z; mirrored in z it goes along.
  expect_near(winding_normal(mesh(scene), 2), {0, 0, 1});
  expect_near(winding_normal(mesh(scene), 3), {0, 0, -1});
}

TEST_F(PbrtTest, VertexNormalsDecideTheSide) {
  const Scene scene = load(
      "WorldBegin Scale 1 1 2 Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"normal N\" [ 0 0 -1 0 0 -1 0 0 -1 ]\n"
      "ReverseOrientation Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"normal N\" [ 0 0 -1 0 0 -1 0 0 -1 ]\n");
  expect_near(winding_normal(mesh(scene), 0), {0, 0, -1});
  expect_near(scene.objects[0].parts[0].normals.at(0), {0, 0, -1});
  expect_near(winding_normal(mesh(scene), 1), {0, 0, 1});
  expect_near(scene.objects[0].parts[1].normals.at(2), {0, 0, 1});
}

TEST_F(PbrtTest, ObjectsUsedTwiceBecomeInstances) {
  const Scene scene = load("WorldBegin Translate 1 0 0 ObjectBegin \"o\" Scale 2 2 2\n" + std::string(kTriangle) +
                           "Shape \"sphere\" ObjectEnd Translate 0 0 3 ObjectInstance \"o\" Identity ObjectInstance \"o\"\n");
  ASSERT_EQ(scene.objects.size(), 2U);
  ASSERT_EQ(scene.instances.size(), 4U);
  EXPECT_EQ(scene.primitive_count(), 4U);
  EXPECT_EQ(scene.stored_primitive_count(), 2U);
  // The definition's own transform comes first, then that of the instance.
  expect_near(mesh(scene).vertices()[1], {3, 0, 0});
  expect_near(scene.instances[0].object_to_world.point(mesh(scene).vertices()[1]), {4, 0, 3});
  EXPECT_TRUE(scene.instances[1].object_to_world.is_identity());
  EXPECT_EQ(spheres(scene, 1).sphere(0).radius, 2.0F);
}

TEST_F(PbrtTest, ObjectsUsedOnceAreFlattenedAndUnusedOnesDropped) {
  const Scene scene = load("WorldBegin ObjectBegin \"once\" Scale -1 1 1\n" + std::string(kTriangle) +
                           "ObjectEnd ObjectBegin \"never\" Shape \"plymesh\" \"string filename\" \"missing.ply\" ObjectEnd\n"
                           "Translate 0 0 3 ObjectInstance \"once\"\n");
  ASSERT_EQ(scene.objects.size(), 1U);
  ASSERT_EQ(scene.instances.size(), 1U);
  EXPECT_TRUE(scene.instances[0].object_to_world.is_identity());
  expect_near(mesh(scene).vertices()[1], {-1, 0, 3});
  expect_near(winding_normal(mesh(scene), 0), {0, 0, 1});
}

TEST_F(PbrtTest, IncludesAndImports) {
  write("part.pbrt", "Translate 0 0 2\n" + std::string(kTriangle));
  const Scene scene =
      load("WorldBegin Import \"part.pbrt\"\n" + std::string(kTriangle) + "Include \"part.pbrt\"\n" + std::string(kTriangle));
  ASSERT_EQ(mesh(scene).part_count(), 4U);
  EXPECT_EQ(mesh(scene).vertices()[0].z, 2.0F);
  EXPECT_EQ(mesh(scene).vertices()[3].z, 0.0F);  // an import leaves the state alone
  EXPECT_EQ(mesh(scene).vertices()[6].z, 2.0F);
  EXPECT_EQ(mesh(scene).vertices()[9].z, 2.0F);
}

TEST_F(PbrtTest, SpellingsThatAreAllowed) {
  const Scene scene = load(
      "\xEF\xBB\xBF# comment \"with a quote\nOption \"bool disablepixeljitter\" true Sampler \"sobol\" \"integer pixelsamples\" 4\n"
      "Integrator \"path\" PixelFilter \"box\" Accelerator \"bvh\" ColorSpace \"srgb\" WorldBegin # rest of the line\n"
      "MakeNamedMaterial \"a name\" \"string type\" \"diffuse\" \"rgb reflectance\" [+1e-1 .2 3.E-1]\n"
      "NamedMaterial \"a name\"Shape \"trianglemesh\"\"point3 P\"[0 0 0 1 0 0 0 1 0]\"integer indices\"[0 1.0 2e0]\n"
      "Attribute \"shape\" \"float radius\" 2 Shape \"sphere\" \"bool unknown\" \"true\" WorldEnd");
  expect_near(material(scene).base_colour.value, {0.1F, 0.2F, 0.3F});
  EXPECT_EQ(spheres(scene, 1).sphere(0).radius, 2.0F);
  EXPECT_TRUE(warns_of(scene, "scene.pbrt:6: the shape \"sphere\" has no parameter \"unknown\""));
}

TEST_F(PbrtTest, MovingTransformsKeepTheStart) {
  const Scene scene =
      load("WorldBegin ActiveTransform EndTime Translate 9 9 9 ActiveTransform StartTime Translate 1 0 0 ActiveTransform All\n" +
           std::string(kTriangle));
  expect_near(mesh(scene).vertices()[0], {1, 0, 0});
  EXPECT_EQ(scene.warnings.size(), 1U);
}

TEST_F(PbrtTest, ShapesUnderUnusableTransformsAreLeftOut) {
  const Scene scene = load_world(
      "AttributeBegin Scale 0 1 1 Shape \"sphere\" AttributeEnd AttributeBegin Scale 1e38 1e38 1e38 Scale 1e38 1e38 1e38 Shape \"sphere\" "
      "AttributeEnd AttributeBegin Transform [ nan 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 ] Shape \"disk\" AttributeEnd\n"
      "AttributeBegin LookAt 0 0 0 0 0 0 0 1 0 Shape \"disk\" LightSource \"point\" AttributeEnd");
  EXPECT_EQ(scene.primitive_count(), 1U);
  EXPECT_TRUE(scene.lights.empty());
  EXPECT_TRUE(warns_of(scene, "scene.pbrt:2: a shape under a transform that is singular"));
}

// The scenes that come with the project, in the directory beside it.
class PbrtScenes : public testing::TestWithParam<std::pair<const char*, std::uint64_t>> {};

TEST_P(PbrtScenes, HaveTheirTriangles) {
  const std::filesystem::path file = std::filesystem::path(GROVE_SOURCE_DIR) / "../shared/scenes" / GetParam().first / "scene-v4.pbrt";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  const Scene scene = load_pbrt(file);
  EXPECT_EQ(scene.primitive_count(), GetParam().second);
  EXPECT_EQ(scene.cameras.size(), 1U);
  EXPECT_GT(scene.film.width, 0U);
  EXPECT_FALSE(scene.bounds().is_empty());
}

INSTANTIATE_TEST_SUITE_P(Shared, PbrtScenes,
                         testing::Values(std::pair("classroom", 103832U), std::pair("coffee-maker", 235271U), std::pair("cornell-box", 36U),
                                         std::pair("country-kitchen", 1443517U), std::pair("water-caustic", 103487U)),
                         [](const auto& scene) {
                           std::string name = scene.param.first;
                           for (char& c : name) c = c == '-' ? '_' : c;
                           return name;
                         });

TEST(PbrtSharedScenes, HairTuftIsFourHundredInstancesOfOneCurve) {
  const std::filesystem::path file = std::filesystem::path(GROVE_SOURCE_DIR) / "../shared/scenes/hair-tuft/scene-v4.pbrt";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  const Scene scene = load_pbrt(file);
  EXPECT_EQ(scene.objects.size(), 1U);
  EXPECT_EQ(scene.instances.size(), 400U);
  EXPECT_EQ(scene.lights.size(), 1U);
  EXPECT_TRUE(scene.environment.is_on());
}

TEST(PbrtSharedScenes, CornellCameraSeesTheBox) {
  const std::filesystem::path file = std::filesystem::path(GROVE_SOURCE_DIR) / "../shared/scenes/cornell-box/scene-v4.pbrt";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  const Scene scene = load_pbrt(file);
  // The file's matrix takes the world point (x, y, z) to (x, y - 1, 6.8 - z) in pbrt's camera, which looks along +z.
  const Mat4& m = scene.cameras.at(0).camera_to_world;
  expect_near(Vec3(m * Vec4(0, 0, 0, 1)), {0, 1, 6.8F});
  expect_near(Vec3(m * Vec4(0, 0, -1, 0)), {0, 0, -1});
  expect_near(Vec3(m * Vec4(1, 0, 0, 0)), {1, 0, 0});
}

}  // namespace
}  // namespace grove
