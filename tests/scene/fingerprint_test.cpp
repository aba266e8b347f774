#include "grove/scene/fingerprint.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <set>
#include <string>

#include "grove/scene/load.h"

namespace grove {
namespace {

// A scene with something in every list.
Scene full_scene() {
  Scene scene = make_builtin_scene("sphereflake?size=2");
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->add_part({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  Object object;
  object.geometry = mesh;
  object.parts.resize(1);
  object.parts[0].normals.resize(3);
  object.parts[0].uvs.resize(3);
  scene.objects.push_back(std::move(object));
  scene.instances.push_back({"", static_cast<std::uint32_t>(scene.objects.size() - 1), Transform()});
  scene.lights.emplace_back();
  scene.textures.emplace_back();
  auto image = std::make_shared<Image>();
  image->width = image->height = image->channels = 1;
  image->bytes = {128};
  scene.images.push_back(image);
  return scene;
}

TEST(Fingerprint, IsTheSameForTheSameScene) {
  for (const char* name : {"cornell", "sphereflake", "gears", "tree", "spheres?layout=clustered", "mount"}) {
    EXPECT_EQ(fingerprint(make_builtin_scene(name)), fingerprint(make_builtin_scene(name))) << name;
  }
}

TEST(Fingerprint, DiffersWhereAPictureMay) {
  const std::map<std::string, std::function<void(Scene&)>> changes{
      {"nothing", [](Scene&) {}},
      {"vertex",
       [](Scene& scene) {
         std::get<0>(scene.objects.back().geometry)->move_vertex(2, {0, 1, 1e-30F});
       }},
      {"triangle", [](Scene& scene) { std::get<0>(scene.objects.back().geometry)->remove_triangle(0); }},
      {"normal", [](Scene& scene) { scene.objects.back().parts[0].normals[1].x = 1.0F; }},
      {"texture coordinate", [](Scene& scene) { scene.objects.back().parts[0].uvs[1].x = 1.0F; }},
      {"attribute", [](Scene& scene) { scene.objects.back().parts[0].normals.clear(); }},
      {"part's material", [](Scene& scene) { scene.objects.back().parts[0].material = 1; }},
      {"orientation", [](Scene& scene) { scene.objects.back().parts[0].flip_orientation = true; }},
      {"transform", [](Scene& scene) { scene.instances.back().object_to_world = Transform(Mat4(Mat3(2.0F))); }},
      {"instance's object", [](Scene& scene) { scene.instances.back().object = 0; }},
      {"instances", [](Scene& scene) { scene.instances.pop_back(); }},
      {"sheen", [](Scene& scene) { scene.materials[0].sheen_colour.value.x = 0.5F; }},
      {"coat", [](Scene& scene) { scene.materials[0].coat.value = 0.5F; }},
      {"range of a light", [](Scene& scene) { scene.lights.back().range = 5.0F; }},
      {"attenuation", [](Scene& scene) { scene.materials[0].attenuation_distance = 1.0F; }},
      {"colour", [](Scene& scene) { scene.materials[0].base_colour.value.z += 0.01F; }},
      {"kind", [](Scene& scene) { scene.materials[0].kind = MaterialKind::interface; }},
      {"channel", [](Scene& scene) { scene.materials[0].alpha.channel = 1; }},
      {"emission", [](Scene& scene) { scene.materials[0].two_sided_emission = !scene.materials[0].two_sided_emission; }},
      {"texture", [](Scene& scene) { scene.textures.back().amount = 0.25F; }},
      {"texel",
       [](Scene& scene) {
         auto image = std::make_shared<Image>(*scene.images.back());
         image->bytes[0] = 129;
         scene.images.back() = image;
       }},
      {"light", [](Scene& scene) { scene.lights.back().intensity.y = 2.0F; }},
      {"environment", [](Scene& scene) { scene.environment.radiance.x += 0.5F; }}};
  std::set<std::uint64_t> values;
  for (const auto& [name, change] : changes) {
    Scene scene = full_scene();
    change(scene);
    EXPECT_TRUE(values.insert(fingerprint(scene)).second) << name;
  }
}

TEST(Fingerprint, IgnoresNamesAndCameras) {
  Scene scene = full_scene();
  const std::uint64_t before = fingerprint(scene);
  scene.name = "another";
  scene.materials[0].name = "another";
  scene.objects[0].name = "another";
  scene.cameras.emplace_back();
  scene.film.width = 99;
  scene.load_seconds = 99.0;
  scene.warn("another");
  EXPECT_EQ(fingerprint(scene), before);
}

}  // namespace
}  // namespace grove
