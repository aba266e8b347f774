#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "grove/scene/formats/obj_parser.h"
#include "grove/scene/formats/text.h"
#include "grove/scene/load.h"
#include "scene/temporary_file.h"

namespace grove {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::string_view kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

const TriangleMesh& mesh_of(const Scene& scene) {
  return *std::get<std::shared_ptr<TriangleMesh>>(scene.objects[0].geometry);
}

Scene load_text(std::string_view content, std::string_view mtl = "") {
  const TemporaryFile file("model.obj", content);
  file.add("model.mtl", mtl);
  return load_scene(file.path().string());
}

std::string error_of(std::string_view content) {
  return input_error_of([&] { (void)load_text(content); });
}

double total_area(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles()) {
    const glm::dvec3 a(mesh.vertices()[t.x]);
    sum += 0.5 * glm::length(glm::cross(glm::dvec3(mesh.vertices()[t.y]) - a, glm::dvec3(mesh.vertices()[t.z]) - a));
  }
  return sum;
}

TEST(ParseFloat, ReadsWhatFilesHold) {
  EXPECT_EQ(parse_float("1.5"), 1.5F);
  EXPECT_EQ(parse_float("+2e3"), 2000.0F);
  EXPECT_EQ(parse_float("-.25"), -0.25F);
  EXPECT_EQ(parse_float("1e-40"), 1e-40F);
  EXPECT_EQ(parse_float("1e-400"), 0.0F);
  EXPECT_EQ(parse_float("-1e400"), -INFINITY);
  EXPECT_EQ(parse_float("1e39"), INFINITY);
  EXPECT_EQ(parse_float("-inf"), -INFINITY);
  EXPECT_EQ(parse_float("-1.#INF"), -INFINITY);
  EXPECT_TRUE(std::isnan(*parse_float("nan")));
  EXPECT_TRUE(std::isnan(*parse_float("-1.#IND")));
  for (const char* word : {"", "-", "+-1", "x", "1x", "1,5", "0x10", "1e"}) EXPECT_FALSE(parse_float(word)) << word;
}

TEST(Obj, ReadsEveryFormOfCorner) {
  const Scene scene = load_text(
      "# comment\r\nv 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\nvt 0 0\r\nvt 1 1\r\nvn 0 0 2\r\n"
      "f 1 2 3\r\nf 1/1 2/2 3/1\r\nf 1//1 2//1 3//1\r\nf -4/1/1 \\\r\n -3/2/-1 -2/1/1 # end\r\n");
  EXPECT_EQ(scene.primitive_count(), 4U);
  const Part& part = scene.objects[0].parts.at(0);
  // (v), (v, vt), (v, vn), (v, vt, vn): three each.
  EXPECT_EQ(mesh_of(scene).vertices().size(), 12U);
  EXPECT_EQ(part.normals.size(), 12U);
  EXPECT_EQ(part.uvs.size(), 12U);
  for (const Vec3& n : part.normals) EXPECT_EQ(n, Vec3(0, 0, 1));
  EXPECT_THAT(scene.warnings, IsEmpty());
}

TEST(Obj, SharesVerticesThatAgreeInAll) {
  const Scene scene = load_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 9 9 9\nf 1 2 3 4\n");
  EXPECT_EQ(mesh_of(scene).vertices().size(), 4U);
  EXPECT_EQ(scene.primitive_count(), 2U);
}

TEST(Obj, MakesOnePartOfEachShapeAndMaterial) {
  const Scene scene = load_text(
      "mtllib model.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\no a\nusemtl red\nf 1 2 3\nusemtl blue\nf 1 2 3\nusemtl red\nf 1 2 3\no b\nf 1 2 3\n"
      "usemtl none\nf 1 2 3\n",
      "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\nKe 0 0 5\n");
  const auto& parts = scene.objects[0].parts;
  ASSERT_EQ(parts.size(), 4U);
  EXPECT_EQ(parts[0].name, "a");
  EXPECT_EQ(parts[2].name, "b");
  EXPECT_EQ(parts[0].material, parts[2].material);
  EXPECT_EQ(mesh_of(scene).first_triangle(1), 2U);
  EXPECT_EQ(scene.materials[parts[0].material].base_colour.value, Vec3(1, 0, 0));
  EXPECT_EQ(scene.materials[parts[1].material].emission.value, Vec3(0, 0, 5));
  EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("'none'")));
}

TEST(Obj, MapsMaterials) {
  const Scene scene = load_text("mtllib model.mtl\nusemtl pbr\n" + std::string(kTriangle),
                                "newmtl lambert\nKd 0.5 0.5 0.5\nNs 10\nillum 2\nKs 0 0 0\n"
                                "newmtl plastic\nKd 0.5 0.5 0.5\nKs 0.5 0.5 0.5\nNs 30\n"
                                "newmtl glass\nKd 0 0 0\nNi 1.33\nTf 1 1 1\nillum 7\n"
                                "newmtl bottle\nNi 1.5\nTf 0.1 0.8 0.2\nillum 6\n"
                                "newmtl mirror\nKd 0.1 0.1 0.1\nKs 0.9 0.8 0.7\nillum 3\nNs 1000000\n"
                                "newmtl veil\nKd 1 1 1\nTr 0.75\n"
                                "newmtl pbr\nKd 1 1 1\nPr 0.3\nPm 1\n");
  const auto find = [&](const std::string& name) {
    return *std::find_if(scene.materials.begin(), scene.materials.end(), [&](const Material& m) { return m.name == name; });
  };
  EXPECT_EQ(find("lambert").kind, MaterialKind::diffuse);
  EXPECT_EQ(find("plastic").kind, MaterialKind::metallic_roughness);
  // Ns 30: alpha = sqrt(2 / 32) = 1/4.
  EXPECT_NEAR(find("plastic").roughness.value, 0.5F, 1e-6F);
  EXPECT_EQ(find("glass").kind, MaterialKind::dielectric);
  EXPECT_EQ(find("glass").ior, 1.33F);
  EXPECT_EQ(find("bottle").transmission.value, 1.0F);
  EXPECT_EQ(find("bottle").base_colour.value, Vec3(0.1F, 0.8F, 0.2F));
  EXPECT_EQ(find("mirror").metallic.value, 1.0F);
  EXPECT_EQ(find("mirror").base_colour.value, Vec3(0.9F, 0.8F, 0.7F));
  EXPECT_LT(find("mirror").roughness.value, 0.05F);
  EXPECT_EQ(find("veil").alpha_mode, AlphaMode::blend);
  EXPECT_EQ(find("veil").alpha.value, 0.25F);
  EXPECT_EQ(find("pbr").metallic.value, 1.0F);
  EXPECT_EQ(find("pbr").roughness.value, 0.3F);
}

TEST(Obj, ReadsTexturesWithVUpward) {
  const TemporaryFile file("model.obj", "mtllib model.mtl\nusemtl m\n" + std::string(kTriangle));
  file.add("model.mtl", "newmtl m\nmap_Kd -s 2 3 1 -o 0.5 0.25 0 -clamp on pixel.tga\n");
  std::string tga(18, '\0');
  tga[2] = 2;
  tga[12] = tga[14] = 1;
  tga[16] = 24;
  file.add("pixel.tga", tga + "abc");
  const Scene scene = load_scene(file.path().string());
  ASSERT_THAT(scene.warnings, IsEmpty());
  ASSERT_EQ(scene.textures.size(), 1U);
  EXPECT_TRUE(scene.textures[0].srgb);
  EXPECT_EQ(scene.textures[0].wrap_u, TextureWrap::clamp);
  EXPECT_EQ(scene.textures[0].uv_transform * Vec3(1, 1, 1), Vec3(2.5F, 1.0F - 3.25F, 1));
}

TEST(Obj, RefusesWhatIsWrongAndSaysWhere) {
  EXPECT_THAT(error_of(""), HasSubstr("nothing renderable"));
  EXPECT_THAT(error_of("v 0 0 0\n"), HasSubstr("nothing renderable"));
  EXPECT_THAT(error_of("v 0 0\n"), HasSubstr("model.obj:line 1: expected 3 numbers"));
  EXPECT_THAT(error_of("v 0 0 zero\n"), HasSubstr("'zero' is not a number"));
  EXPECT_THAT(error_of(std::string(kTriangle) + "f 1 2 4\n"), HasSubstr("line 5: a face names vertex 4, but there are 3"));
  EXPECT_THAT(error_of(std::string(kTriangle) + "f 1 2 -4\n"), HasSubstr("vertex -4"));
  EXPECT_THAT(error_of(std::string(kTriangle) + "f 1 2 0\n"), HasSubstr("count from 1"));
  EXPECT_THAT(error_of(std::string(kTriangle) + "f 1/1 2 3\n"), HasSubstr("texture coordinate 1"));
  EXPECT_THAT(error_of(std::string(kTriangle) + "f 1//9 2 3\n"), HasSubstr("normal 9"));
  EXPECT_THAT(error_of(std::string(kTriangle) + "f 1 2\n"), HasSubstr("2 corners"));
  EXPECT_THAT(error_of(std::string(kTriangle) + "f 1 2 99999999999999999999\n"), HasSubstr("not an index"));
}

TEST(Obj, ReadsTheSharedModels) {
  if (!std::filesystem::exists(shared_scene("bad"))) GTEST_SKIP() << "the shared scenes are not there";
  const Scene box = load_scene(shared_scene("cornell-box/CornellBox-Original.obj").string());
  EXPECT_EQ(box.primitive_count(), 36U);
  EXPECT_EQ(box.objects[0].parts.size(), 8U);
  EXPECT_EQ(std::count_if(box.materials.begin(), box.materials.end(), [](const Material& m) { return m.is_emissive(); }), 1);
  EXPECT_THAT(box.warnings, IsEmpty());
  EXPECT_EQ(load_scene(shared_scene("stanford-scans/armadillo.obj").string()).primitive_count(), 50000U);
}

TEST(Obj, TakesOrRefusesEveryBadFile) {
  if (!std::filesystem::exists(shared_scene("bad"))) GTEST_SKIP() << "the shared scenes are not there";
  const auto load = [](const char* name) { return load_scene(shared_scene(std::string("bad/") + name).string()); };
  const auto error = [&](const char* name) { return input_error_of([&] { (void)load(name); }); };
  EXPECT_THAT(error("malformed.obj"), HasSubstr("vertex 12"));
  EXPECT_THAT(error("issue-140-zero-face-idx.obj"), HasSubstr("count from 1"));

  const Scene nan = load("test-nan.obj");
  EXPECT_GT(nan.primitive_count(), 0U);
  EXPECT_THAT(nan.warnings, testing::Contains(HasSubstr("triangles were left out")));
  EXPECT_TRUE(std::isfinite(glm::length(nan.bounds().extent())));

  EXPECT_THAT(load("missing_material_file.obj").warnings, testing::Contains(HasSubstr("materials that no library defines")));
  const Scene untextured = load("missing_texture.obj");
  EXPECT_THAT(untextured.warnings, ElementsAre(HasSubstr("no_such_file.png")));
  EXPECT_EQ(untextured.materials[0].base_colour.texture, kNoTexture);
  EXPECT_EQ(load("zero_area.obj").primitive_count(), 5U);
  EXPECT_EQ(load("duplicate_faces.obj").primitive_count(), 1000U);
}

TEST(Obj, CutsAConcavePolygonOfFortyCorners) {
  if (!std::filesystem::exists(shared_scene("bad"))) GTEST_SKIP() << "the shared scenes are not there";
  const ObjFile obj = parse_obj(shared_scene("bad/concave_and_large_polygon.obj"));
  const Scene scene = load_scene(shared_scene("bad/concave_and_large_polygon.obj").string());
  ASSERT_EQ(scene.primitive_count(), obj.positions.size() - 2);
  // By Newell's formula, from the corners in their order.
  glm::dvec3 normal(0.0);
  for (std::size_t i = 0; i < obj.positions.size(); ++i) {
    normal += glm::cross(glm::dvec3(obj.positions[i]), glm::dvec3(obj.positions[(i + 1) % obj.positions.size()]));
  }
  EXPECT_NEAR(total_area(mesh_of(scene)) / (0.5 * glm::length(normal)), 1.0, 1e-5);
}

// Whatever the bytes: a valid scene or an InputError.
TEST(Obj, SurvivesMutations) {
  const std::string base =
      "mtllib model.mtl\no shape\nv 0 0 0\nv 1 0 0.5\nv 1 1 1e-3\nv 0 1 0\nv 0.4 0.5 0\nvt 0 0\nvt 1 1\nvn 0 0 1\nusemtl m\n"
      "f 1/1/1 2/2/1 3/1/1 4/2/1 5/1/1\ng other\ns 1\nf -5//1 -4//1 -1//1\nl 1 2\n";
  const std::string library = "newmtl m\nKd 0.5 0.4 0.3\nKs 0.1 0.1 0.1\nNs 20\nd 0.5\nillum 4\nmap_Kd -s 1 2 3 -o 1 none.png\nPr 0.5\n";
  const TemporaryFile file("model.obj", "");
  int read = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    try {
      file.rewrite(mutated(base, seed));
      file.add("model.mtl", mutated(library, seed + 1000));
      const Scene scene = load_scene(file.path().string());
      ASSERT_GT(scene.primitive_count(), 0U);
      ++read;
    } catch (const InputError& error) {
      ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  EXPECT_GT(read, 50);
  EXPECT_LT(read, 550);
}

}  // namespace
}  // namespace grove
