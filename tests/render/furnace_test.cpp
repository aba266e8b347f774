// Furnace tests: where light comes from everywhere alike, what a surface shows is known in closed form.

#include <gtest/gtest.h>

#include <cmath>

#include "test_scenes.h"

namespace grove {
namespace {

using testing::SceneMaker;

// In a closed sphere of emission L and albedo a, each surface on the way adds its share: L (1 + a + a^2 + ... + a^depth).
TEST(Furnace, ClosedSphereSumsTheGeometricSeries) {
  const float albedo = 0.6F;
  for (const std::uint32_t depth : {0U, 1U, 2U, 5U}) {
    SceneMaker maker;
    Material wall = SceneMaker::diffuse(Vec3(albedo));
    wall.emission.value = Vec3(0.5F, 1.0F, 2.0F);
    maker.sphere({{0.0F, 0.0F, 0.0F}, 3.0F}, maker.material(wall));
    maker.camera({0.4F, 0.3F, 0.9F}, {0.0F, 0.2F, -1.0F});
    const RenderResult result = testing::render_scene(maker.make(), testing::small_settings(8, 256, depth));
    const float series = (1.0F - std::pow(albedo, static_cast<float>(depth + 1))) / (1.0F - albedo);
    const Vec3 mean = testing::mean_radiance(result);
    EXPECT_NEAR(mean.x, 0.5F * series, 0.01F * series) << "depth " << depth;
    EXPECT_NEAR(mean.y, 1.0F * series, 0.02F * series) << "depth " << depth;
    EXPECT_NEAR(mean.z, 2.0F * series, 0.04F * series) << "depth " << depth;
    EXPECT_EQ(result.dropped_samples, 0U);
  }
}

// The same with triangles, whose emission is sampled in another way.
TEST(Furnace, ClosedBoxSumsTheGeometricSeries) {
  SceneMaker maker;
  Material wall = SceneMaker::diffuse(Vec3(0.5F));
  wall.emission.value = Vec3(1.0F);
  const std::uint32_t id = maker.material(wall);
  maker.quad({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, id);
  maker.quad({0, 1, 0}, {1, 0, 0}, {0, 0, 1}, id);
  maker.quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, id);
  maker.quad({0, 0, 1}, {0, 1, 0}, {1, 0, 0}, id);
  maker.quad({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, id);
  maker.quad({1, 0, 0}, {0, 0, 1}, {0, 1, 0}, id);
  maker.camera({0.5F, 0.4F, 0.8F}, {0.4F, 0.5F, 0.1F}, 1.2F);
  const RenderResult result = testing::render_scene(maker.make(), testing::small_settings(12, 512, 4));
  EXPECT_NEAR(testing::mean_radiance(result).y, 1.0F + 0.5F + 0.25F + 0.125F + 0.0625F, 0.03F);
}

struct LosslessCase {
  const char* name;
  MaterialKind kind;
  float roughness;
  float metallic;
};

class LosslessFurnace : public ::testing::TestWithParam<LosslessCase> {};

// A lossless object in a white sky cannot be seen.
TEST_P(LosslessFurnace, ObjectVanishes) {
  Material material;
  material.kind = GetParam().kind;
  material.base_colour.value = Vec3(1.0F);
  material.roughness.value = GetParam().roughness;
  material.coat_roughness.value = GetParam().roughness;
  material.metallic.value = GetParam().metallic;
  SceneMaker maker;
  maker.sphere({{0.0F, 0.0F, 0.0F}, 1.0F}, maker.material(material));
  maker.scene().environment.radiance = Vec3(1.0F);
  maker.camera({0.0F, 0.0F, 3.0F}, {0.0F, 0.0F, 0.0F}, 0.9F);
  // Deep enough for light that is caught in glass.
  const RenderResult result = testing::render_scene(maker.make(), testing::small_settings(16, 256, 64));
  for (std::uint32_t y = 0; y < 16; y += 5) {
    for (std::uint32_t x = 0; x < 16; x += 5) EXPECT_NEAR(result.film.mean(x, y).radiance.y, 1.0F, 0.1F) << x << ", " << y;
  }
  EXPECT_NEAR(testing::mean_radiance(result).y, 1.0F, 0.012F);
  EXPECT_EQ(result.dropped_samples, 0U);
}

INSTANTIATE_TEST_SUITE_P(Materials, LosslessFurnace,
                         ::testing::Values(LosslessCase{"diffuse", MaterialKind::diffuse, 1.0F, 0.0F},
                                           LosslessCase{"glass", MaterialKind::dielectric, 0.0F, 0.0F},
                                           LosslessCase{"rough_glass", MaterialKind::dielectric, 0.6F, 0.0F},
                                           LosslessCase{"pane", MaterialKind::thin_dielectric, 0.0F, 0.0F},
                                           LosslessCase{"mirror", MaterialKind::conductor, 0.0F, 0.0F},
                                           LosslessCase{"rough_metal", MaterialKind::conductor, 0.8F, 0.0F},
                                           LosslessCase{"varnish", MaterialKind::coated_diffuse, 0.0F, 0.0F},
                                           LosslessCase{"rough_varnish", MaterialKind::coated_diffuse, 0.5F, 0.0F},
                                           LosslessCase{"lacquered_metal", MaterialKind::coated_conductor, 0.0F, 0.0F},
                                           LosslessCase{"gltf_plastic", MaterialKind::metallic_roughness, 0.5F, 0.0F},
                                           LosslessCase{"gltf_metal", MaterialKind::metallic_roughness, 0.5F, 1.0F}),
                         [](const auto& material) { return material.param.name; });

// Seen through surfaces that let everything pass, a white sky stays white; half-transparent black ones take half each.
TEST(Furnace, TransparencyTakesItsShare) {
  for (const MaterialKind kind : {MaterialKind::interface, MaterialKind::diffuse}) {
    Material veil = SceneMaker::diffuse(Vec3(0.0F));
    veil.kind = kind;
    if (kind == MaterialKind::diffuse) {
      veil.alpha_mode = AlphaMode::blend;
      veil.alpha.value = 0.5F;
    }
    SceneMaker maker;
    const std::uint32_t id = maker.material(veil);
    maker.quad({-5, -5, 0}, {10, 0, 0}, {0, 10, 0}, id);
    maker.quad({-5, -5, -1}, {10, 0, 0}, {0, 10, 0}, id);
    maker.scene().environment.radiance = Vec3(1.0F);
    maker.camera({0.0F, 0.0F, 3.0F}, {0.0F, 0.0F, 0.0F});
    const RenderResult result = testing::render_scene(maker.make(), testing::small_settings(8, 256, 1));
    EXPECT_NEAR(testing::mean_radiance(result).y, kind == MaterialKind::interface ? 1.0F : 0.25F, 0.01F);
  }
}

// A sphere has two sides, each with a chance of its own.
TEST(Furnace, BothSidesOfASphereTakeTheirShare) {
  Material veil = SceneMaker::diffuse(Vec3(0.0F));
  veil.alpha_mode = AlphaMode::blend;
  veil.alpha.value = 0.4F;
  SceneMaker maker;
  maker.sphere({{0.0F, 0.0F, 0.0F}, 1.0F}, maker.material(veil));
  maker.scene().environment.radiance = Vec3(1.0F);
  maker.camera({0.0F, 0.0F, 3.0F}, {0.0F, 0.0F, 0.0F}, 0.1F);
  EXPECT_NEAR(testing::mean_radiance(testing::render_scene(maker.make(), testing::small_settings(8, 256, 1))).y, 0.36F, 0.01F);
}

Material coloured_volume(const Vec3& colour, float distance) {
  Material material;
  material.roughness.value = 0.0F;
  material.transmission.value = 1.0F;
  material.thin_walled = false;
  material.ior = 1.0F;  // bends nothing, so that ways are straight
  material.attenuation_colour = colour;
  material.attenuation_distance = distance;
  return material;
}

// Beer's law along ways of known length: through one volume, through one inside of another, and up to a lamp inside.
TEST(Furnace, VolumesAbsorbByBeersLaw) {
  const Vec3 outer(0.5F, 0.25F, 1.0F);
  const Vec3 inner(0.5F, 1.0F, 0.25F);
  for (const bool is_nested : {false, true}) {
    for (const bool has_lamp : {false, true}) {
      SceneMaker maker;
      maker.sphere({{0.0F, 0.0F, 0.0F}, 1.0F}, maker.material(coloured_volume(outer, 0.5F)));
      if (is_nested) maker.sphere({{0.0F, 0.0F, 0.0F}, 0.5F}, maker.material(coloured_volume(inner, 1.0F)));
      if (has_lamp) maker.sphere({{0.0F, 0.0F, 0.0F}, 0.1F}, maker.material(SceneMaker::lamp(Vec3(2.0F))));
      maker.scene().environment.radiance = Vec3(1.0F);
      maker.camera({0.0F, 0.0F, 3.0F}, {0.0F, 0.0F, 0.0F}, 0.01F);
      const Vec3 seen = testing::mean_radiance(testing::render_scene(maker.make(), testing::small_settings(4, 4)));
      // In units of the attenuation distances.
      const float outer_way = (has_lamp ? (is_nested ? 0.5F : 0.9F) : (is_nested ? 1.0F : 2.0F)) / 0.5F;
      const float inner_way = is_nested ? (has_lamp ? 0.4F : 1.0F) : 0.0F;
      for (int channel = 0; channel < 3; ++channel) {
        const float expected = (has_lamp ? 2.0F : 1.0F) * std::pow(outer[channel], outer_way) * std::pow(inner[channel], inner_way);
        EXPECT_NEAR(seen[channel], expected, 0.002F) << "nested " << is_nested << ", lamp " << has_lamp << ", channel " << channel;
      }
    }
  }
}

// Light from a lamp inside is absorbed on its way to a surface inside as well.
TEST(Furnace, VolumesAbsorbLightFromLampsInside) {
  const auto render = [](bool absorbs) {
    SceneMaker maker;
    maker.sphere({{0.0F, 0.0F, 0.0F}, 4.0F}, maker.material(coloured_volume(Vec3(0.5F), absorbs ? 2.0F : 1e30F)));
    maker.sphere({{0.0F, 0.0F, -1.0F}, 0.5F}, maker.material(SceneMaker::diffuse(Vec3(0.5F))));
    PunctualLight& lamp = maker.scene().lights.emplace_back();
    lamp.position = {0.0F, 0.6F, 0.3F};
    lamp.intensity = Vec3(10.0F);
    maker.camera({0.0F, 0.0F, 6.0F}, {0.0F, 0.0F, -0.5F}, 0.002F);
    return testing::mean_radiance(testing::render_scene(maker.make(), testing::small_settings(2, 4, 3))).y;
  };
  // From the nearest point of the inner sphere, (0, 0, -0.5): 4.5 units to the boundary before the camera, and 1 to the lamp.
  EXPECT_NEAR(render(true) / render(false), std::pow(0.5F, 5.5F / 2.0F), 0.002F);
}

Material coated_lamp(float roughness) {
  Material lamp;
  lamp.base_colour.value = Vec3(0.0F);
  lamp.specular.value = 0.0F;
  lamp.emission.value = Vec3(3.0F);
  lamp.coat.value = 0.5F;
  lamp.coat_roughness.value = roughness;
  return lamp;
}

// A clear coat takes from the light below what it reflects (KHR_materials_clearcoat): 0.04 seen straight on, more at grazing angles; none where it is not.
TEST(Furnace, ClearCoatsDimWhatShinesBelow) {
  for (const float degrees : {0.0F, 60.0F, 80.0F}) {
    const float angle = degrees * kPi / 180.0F;
    SceneMaker maker;
    maker.quad({-50, -50, 0}, {100, 0, 0}, {0, 100, 0}, maker.material(coated_lamp(0.0F)));
    maker.camera({3.0F * std::sin(angle), 0.0F, 3.0F * std::cos(angle)}, {0.0F, 0.0F, 0.0F}, 0.002F);
    const float fresnel = 0.04F + 0.96F * std::pow(1.0F - std::cos(angle), 5.0F);
    EXPECT_NEAR(testing::mean_radiance(testing::render_scene(maker.make(), testing::small_settings(4, 4, 0))).y,
                3.0F * (1.0F - 0.5F * fresnel), 1e-3F)
        << degrees;
  }
}

// What the coat keeps back of a sky of the same brightness it sends back: nothing is lost, and the lamp looks like one without a coat.
TEST(Furnace, CoatedLampsVanishInASkyAsBright) {
  for (const float roughness : {0.0F, 0.6F}) {
    SceneMaker maker;
    maker.sphere({{0.0F, 0.0F, 0.0F}, 1.0F}, maker.material(coated_lamp(roughness)));
    maker.scene().environment.radiance = Vec3(3.0F);
    maker.camera({0.0F, 0.0F, 3.0F}, {0.0F, 0.0F, 0.0F}, 0.6F);
    EXPECT_NEAR(testing::mean_radiance(testing::render_scene(maker.make(), testing::small_settings(16, 64, 1))).y, 3.0F, 0.02F)
        << roughness;
  }
}

// What glTF calls unlit: the same radiance from both sides, in the mesh's own colours.
TEST(Furnace, UnlitSurfacesShowTheirVertexColours) {
  Material unlit = SceneMaker::lamp(Vec3(0.5F, 0.25F, 1.0F), true);
  unlit.emits_vertex_colour = true;
  for (const float side : {1.0F, -1.0F}) {
    SceneMaker maker;
    maker.quad({-5, -5, 0}, {10, 0, 0}, {0, 10, 0}, maker.material(unlit));
    maker.camera({0.0F, 0.0F, 3.0F * side}, {0.0F, 0.0F, 0.0F});
    Scene scene = maker.make();
    scene.objects[0].parts[0].colours.assign(4, Vec4(0.5F, 1.0F, 0.25F, 1.0F));
    EXPECT_LT(glm::distance(testing::mean_radiance(testing::render_scene(scene, testing::small_settings(4, 2))), Vec3(0.25F)), 1e-5F);
  }
}

}  // namespace
}  // namespace grove
