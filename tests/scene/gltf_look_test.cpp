#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "scene/gltf_fixture.h"

namespace grove {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Json = nlohmann::json;

class GltfLook : public Gltf {};

TEST_F(GltfLook, FactorsOfMaterials) {
  const Material m = load_material({{"name", "paint"},
                                    {"pbrMetallicRoughness", {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"roughnessFactor", 0.25}}},
                                    {"alphaMode", "MASK"},
                                    {"alphaCutoff", 0.75},
                                    {"emissiveFactor", {1, 0.5, 0}},
                                    {"extensions",
                                     {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}},
                                      {"KHR_materials_ior", {{"ior", 1.33}}},
                                      {"KHR_materials_transmission", {{"transmissionFactor", 0.9}}},
                                      {"KHR_materials_volume", {{"thicknessFactor", 1}}}}}});
  EXPECT_EQ(m.name, "paint");
  EXPECT_EQ(m.kind, MaterialKind::metallic_roughness);
  EXPECT_EQ(m.base_colour.value, Vec3(0.1F, 0.2F, 0.3F));
  EXPECT_EQ(m.alpha.value, 0.4F);
  EXPECT_EQ(m.metallic.value, 1.0F);
  EXPECT_EQ(m.roughness.value, 0.25F);
  EXPECT_EQ(m.alpha_mode, AlphaMode::mask);
  EXPECT_EQ(m.alpha_cutoff, 0.75F);
  EXPECT_EQ(m.emission.value, Vec3(8, 4, 0));
  EXPECT_EQ(m.ior, 1.33F);
  EXPECT_EQ(m.transmission.value, 0.9F);
  EXPECT_FALSE(m.thin_walled);
}

TEST_F(GltfLook, PrimitivesWithoutMaterialTakeTheDefault) {
  file_.add_node({{"mesh", file_.add_triangle()}});
  file_.json["materials"] = {{{"name", "unused"}}};
  const Scene scene = load();
  ASSERT_EQ(scene.materials.size(), 2U);
  EXPECT_EQ(scene.objects[0].parts[0].material, 1U);
  EXPECT_EQ(scene.materials[1].metallic.value, 1.0F);
}

TEST_F(GltfLook, UnlitSurfacesEmitTheirBaseColour) {
  const Material m = load_material(
      {{"pbrMetallicRoughness", {{"baseColorFactor", {0.1, 0.2, 0.3, 0.5}}}}, {"extensions", {{"KHR_materials_unlit", Json::object()}}}});
  EXPECT_EQ(m.emission.value, Vec3(0.1F, 0.2F, 0.3F));
  EXPECT_EQ(m.base_colour.value, Vec3(0.0F));
  EXPECT_EQ(m.alpha.value, 0.5F);
  EXPECT_TRUE(m.emits_vertex_colour && m.two_sided_emission);
  EXPECT_THAT(scene_.warnings, ElementsAre());
}

// Each extension with its textures, whose transforms and sets of coordinates are their own.
TEST_F(GltfLook, LayersOfMaterials) {
  file_.json["images"] = {{{"bufferView", file_.add_view(small_png())}}};
  file_.json["textures"] = {{{"source", 0}}};
  const Json plain = {{"index", 0}};
  const Json moved = {{"index", 0}, {"texCoord", 3}, {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0}}, {"texCoord", 1}}}}}};
  const Material m = load_material(
      {{"extensions",
        {{"KHR_materials_specular",
          {{"specularFactor", 0.5}, {"specularTexture", moved}, {"specularColorFactor", {2, 0.5, 0}}, {"specularColorTexture", plain}}},
         {"KHR_materials_clearcoat",
          {{"clearcoatFactor", 0.75},
           {"clearcoatTexture", plain},
           {"clearcoatRoughnessFactor", 0.25},
           {"clearcoatRoughnessTexture", plain},
           {"clearcoatNormalTexture", {{"index", 0}, {"scale", 0.5}}}}},
         {"KHR_materials_sheen",
          {{"sheenColorFactor", {0.25, 0.5, 1}},
           {"sheenColorTexture", plain},
           {"sheenRoughnessFactor", 0.5},
           {"sheenRoughnessTexture", plain}}},
         {"KHR_materials_volume", {{"thicknessFactor", 1}, {"attenuationDistance", 0.25}, {"attenuationColor", {1, 0.5, 0}}}}}}});
  EXPECT_EQ(m.specular.value, 0.5F);
  EXPECT_EQ(m.specular.channel, 3U);
  EXPECT_EQ(m.specular_colour.value, Vec3(2.0F, 0.5F, 0.0F));
  EXPECT_EQ(m.coat.value, 0.75F);
  EXPECT_EQ(m.coat.channel, 0U);
  EXPECT_EQ(m.coat_roughness.value, 0.25F);
  EXPECT_EQ(m.coat_roughness.channel, 1U);
  EXPECT_EQ(m.coat_normal_scale, 0.5F);
  EXPECT_EQ(m.sheen_colour.value, Vec3(0.25F, 0.5F, 1.0F));
  EXPECT_EQ(m.sheen_roughness.value, 0.5F);
  EXPECT_EQ(m.sheen_roughness.channel, 3U);
  EXPECT_EQ(m.attenuation_distance, 0.25F);
  EXPECT_EQ(m.attenuation_colour, Vec3(1.0F, 0.5F, 0.0F));
  // One read as a colour, one as data, and the one with a transform.
  ASSERT_EQ(scene_.textures.size(), 3U);
  EXPECT_EQ(m.specular_colour.texture, m.sheen_colour.texture);
  EXPECT_TRUE(scene_.textures.at(m.sheen_colour.texture).srgb);
  EXPECT_EQ(m.coat.texture, m.coat_normal_texture);
  EXPECT_FALSE(scene_.textures.at(m.coat.texture).srgb);
  EXPECT_EQ(scene_.textures.at(m.specular.texture).uv_set, 1U);
  EXPECT_EQ(scene_.textures.at(m.specular.texture).uv_transform[2].x, 0.5F);
  EXPECT_THAT(scene_.warnings, ElementsAre());
}

TEST_F(GltfLook, BackSidesShineWhereSurfacesAreDoubleSided) {
  EXPECT_FALSE(load_material({{"emissiveFactor", {1, 1, 1}}}).two_sided_emission);
  file_ = {};
  EXPECT_TRUE(load_material({{"emissiveFactor", {1, 1, 1}}, {"doubleSided", true}}).two_sided_emission);
}

TEST_F(GltfLook, VariantsAreLeftOutWithANote) {
  file_.json["extensionsUsed"] = {"KHR_materials_variants"};
  file_.json["extensions"] = {{"KHR_materials_variants", {{"variants", {{{"name", "red"}}, {{"name", "blue"}}}}}}};
  (void)load_material(Json::object());
  EXPECT_THAT(scene_.warnings, ElementsAre(HasSubstr("2 variants")));
}

TEST_F(GltfLook, SpecularGlossinessIsApproximatedWithAWarning) {
  const Json gold = {{"diffuseFactor", {0, 0, 0, 1}}, {"specularFactor", {1, 0.8, 0.3}}, {"glossinessFactor", 0.75}};
  const Material m = load_material({{"extensions", {{"KHR_materials_pbrSpecularGlossiness", gold}}}});
  EXPECT_GT(m.metallic.value, 0.9F);
  EXPECT_EQ(m.roughness.value, 0.25F);
  EXPECT_NEAR(m.base_colour.value.y, 0.8F, 0.1F);
  EXPECT_THAT(scene_.warnings, Contains(HasSubstr("KHR_materials_pbrSpecularGlossiness")));
}

TEST_F(GltfLook, TexturesSayHowTheyAreEncodedWrappedAndFiltered) {
  file_.json["images"] = {{{"bufferView", file_.add_view(small_png())}, {"mimeType", "image/png"}}};
  file_.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
  file_.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
  const Json texture = {{"index", 0}};
  const Material m = load_material({{"pbrMetallicRoughness", {{"baseColorTexture", texture}, {"metallicRoughnessTexture", texture}}},
                                    {"normalTexture", {{"index", 0}, {"scale", 0.5}}},
                                    {"emissiveTexture", texture},
                                    {"alphaMode", "BLEND"}});
  // One texture read as a colour, one read as data; the image is there once. An emissive factor of 0 needs no texture.
  ASSERT_EQ(scene_.textures.size(), 2U);
  ASSERT_EQ(scene_.images.size(), 1U);
  EXPECT_EQ(scene_.images[0]->width, 2U);
  const Texture& colour = scene_.textures.at(m.base_colour.texture);
  EXPECT_TRUE(colour.srgb);
  EXPECT_EQ(colour.wrap_u, TextureWrap::clamp);
  EXPECT_EQ(colour.wrap_v, TextureWrap::mirror);
  EXPECT_EQ(colour.filter, TextureFilter::nearest);
  EXPECT_EQ(m.alpha.texture, m.base_colour.texture);
  EXPECT_EQ(m.alpha.channel, 3U);
  EXPECT_EQ(m.alpha_mode, AlphaMode::blend);
  EXPECT_FALSE(scene_.textures.at(m.normal_texture).srgb);
  EXPECT_EQ(m.normal_scale, 0.5F);
  EXPECT_EQ(m.metallic.texture, m.normal_texture);
  EXPECT_EQ(m.metallic.channel, 2U);
  EXPECT_EQ(m.roughness.channel, 1U);
  EXPECT_EQ(m.emission.texture, kNoTexture);
}

TEST_F(GltfLook, TextureTransformsScaleThenTurnThenMove) {
  file_.json["images"] = {{{"bufferView", file_.add_view(small_png())}}};
  file_.json["textures"] = {{{"source", 0}}};
  const Json transform = {{"offset", {0.25, 0.5}}, {"scale", {2, 3}}, {"rotation", std::acos(0.0)}};
  const Json info = {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}};
  const Material m = load_material({{"pbrMetallicRoughness", {{"baseColorTexture", info}}}});
  const Mat3& matrix = scene_.textures.at(m.base_colour.texture).uv_transform;
  // A quarter turn anticlockwise, as seen with v downwards, takes u to -v and v to u.
  const Vec3 u = matrix * Vec3(1, 0, 1);
  const Vec3 v = matrix * Vec3(0, 1, 1);
  EXPECT_LT(glm::distance(u, Vec3(0.25F, 0.5F - 2.0F, 1)), 1e-6F);
  EXPECT_LT(glm::distance(v, Vec3(0.25F + 3.0F, 0.5F, 1)), 1e-6F);
}

TEST_F(GltfLook, TheSecondSetOfTextureCoordinatesIsReadWhereATextureUsesIt) {
  file_.json["images"] = {{{"bufferView", file_.add_view(small_png())}}};
  file_.json["textures"] = {{{"source", 0}}};
  const int mesh = file_.add_triangle();
  Json& primitive = file_.json["meshes"][static_cast<std::size_t>(mesh)]["primitives"][0];
  primitive["attributes"]["TEXCOORD_1"] = file_.add(std::vector<Vec2>{{0, 0}, {0.25F, 0}, {0, 0.5F}});
  primitive["material"] = 0;
  file_.add_node({{"mesh", mesh}});
  for (const int set : {0, 1}) {
    file_.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", set}}}}}}};
    const Scene scene = load();
    EXPECT_EQ(scene.objects[0].parts[0].second_uvs.size(), set == 0 ? 0U : 3U);
    if (set == 1) {
      EXPECT_EQ(scene.objects[0].parts[0].second_uvs[1], Vec2(0.25F, 0.0F));
    }
    EXPECT_THAT(scene.warnings, ElementsAre());
  }
}

TEST_F(GltfLook, FurtherTextureCoordinateSetsAreAWarning) {
  file_.json["images"] = {{{"bufferView", file_.add_view(small_png())}}};
  file_.json["textures"] = {{{"source", 0}}};
  (void)load_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 2}}}}}});
  EXPECT_THAT(scene_.warnings, ElementsAre(HasSubstr("materials[0].pbrMetallicRoughness.baseColorTexture")));
}

TEST_F(GltfLook, AMissingImageIsAWarningAndTheFactorStays) {
  file_.json["images"] = {{{"uri", "absent.png"}}};
  file_.json["textures"] = {{{"source", 0}}};
  const Json pbr = {{"baseColorTexture", {{"index", 0}}}, {"baseColorFactor", {0.5, 0.5, 0.5, 1}}};
  const Material m = load_material({{"pbrMetallicRoughness", pbr}});
  EXPECT_EQ(m.base_colour.texture, kNoTexture);
  EXPECT_EQ(m.base_colour.value, Vec3(0.5F));
  EXPECT_THAT(scene_.warnings, ElementsAre(HasSubstr("absent.png")));
}

TEST_F(GltfLook, PunctualLights) {
  file_.add_node({{"mesh", file_.add_triangle()}});
  const Json lights = {{{"type", "point"}, {"intensity", 40}, {"color", {1, 0.5, 0.25}}, {"name", "lamp"}},
                       {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.6}}}},
                       {{"type", "directional"}, {"intensity", 3}}};
  file_.json["extensions"] = {{"KHR_lights_punctual", {{"lights", lights}}}};
  const double half = std::sqrt(0.5);
  for (int i = 0; i < 3; ++i) {
    // A quarter turn about x, backwards, takes -z to -y.
    file_.add_node({{"translation", {i, 2, 3}},
                    {"rotation", {-half, 0, 0, half}},
                    {"scale", {5, 5, 5}},
                    {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
  }
  const Scene scene = load();
  ASSERT_EQ(scene.lights.size(), 3U);
  EXPECT_EQ(scene.lights[0].name, "lamp");
  EXPECT_EQ(scene.lights[0].kind, PunctualLightKind::point);
  EXPECT_EQ(scene.lights[0].intensity, Vec3(40, 20, 10));
  EXPECT_EQ(scene.lights[1].kind, PunctualLightKind::spot);
  EXPECT_EQ(scene.lights[1].position, Vec3(1, 2, 3));
  EXPECT_LT(glm::distance(scene.lights[1].direction, Vec3(0, -1, 0)), 1e-6F);
  EXPECT_EQ(scene.lights[1].inner_angle, 0.2F);
  EXPECT_EQ(scene.lights[1].outer_angle, 0.6F);
  EXPECT_EQ(scene.lights[2].kind, PunctualLightKind::directional);
  EXPECT_EQ(scene.lights[2].intensity, Vec3(3.0F));
}

TEST_F(GltfLook, RangesOfLightsAreAboveZero) {
  file_.add_node({{"mesh", file_.add_triangle()}});
  const Json lights = {
      {{"type", "point"}, {"range", 7.5}}, {{"type", "spot"}, {"range", 0}}, {{"type", "point"}, {"range", -1}}, {{"type", "point"}}};
  file_.json["extensions"] = {{"KHR_lights_punctual", {{"lights", lights}}}};
  for (int i = 0; i < 4; ++i) file_.add_node({{"scale", {5, 5, 5}}, {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
  const Scene scene = load();
  ASSERT_EQ(scene.lights.size(), 4U);
  EXPECT_EQ(scene.lights[0].range, 7.5F) << "whatever the scale of the node";
  for (int i = 1; i < 4; ++i) EXPECT_EQ(scene.lights[i].range, std::numeric_limits<float>::infinity()) << i;
  EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("lights[1]")));
}

TEST_F(GltfLook, CamerasTurnAndMoveButDoNotScale) {
  file_.add_node({{"mesh", file_.add_triangle()}});
  file_.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}, {{"type", "orthographic"}}};
  file_.add_node({{"camera", 0}, {"name", "front"}, {"translation", {0, 1, 8}}, {"scale", {2, 2, 2}}});
  file_.add_node({{"camera", 1}});
  const Scene scene = load();
  ASSERT_EQ(scene.cameras.size(), 1U);
  EXPECT_EQ(scene.cameras[0].name, "front");
  EXPECT_EQ(scene.cameras[0].field_of_view, 0.7F);
  EXPECT_EQ(scene.cameras[0].axis, FieldOfViewAxis::vertical);
  EXPECT_EQ(Vec3(scene.cameras[0].camera_to_world * Vec4(0, 0, -1, 1)), Vec3(0, 1, 7));
  EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("orthographic")));
}

}  // namespace
}  // namespace grove
