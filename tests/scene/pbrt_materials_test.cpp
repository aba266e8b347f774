#include <cmath>

#include "scene/pbrt_file.h"

// Materials, textures and spectra.

namespace grove {
namespace {

class PbrtMaterials : public PbrtTest {
 protected:
  Scene load_material(std::string_view directive) const {
    return load("WorldBegin\n" + std::string(directive) + "\n" + std::string(kTriangle));
  }
  Material material_of(std::string_view directive) const { return material(load_material(directive)); }

  // A 2 x 1 picture: 0 and 0.5 as floats, in the order of the file.
  void write_pfm() const { write("two.pfm", std::string("Pf\n2 1\n-1.0\n") + std::string("\0\0\0\0\0\0\0\x3f", 8)); }
};

TEST_F(PbrtMaterials, DiffuseIsTheDefault) {
  const Material m = material_of("");
  EXPECT_EQ(m.kind, MaterialKind::diffuse);
  expect_near(m.base_colour.value, Vec3(0.5F));
  expect_near(material_of("Material \"diffuse\" \"rgb reflectance\" [ .1 .2 2 ]").base_colour.value, {0.1F, 0.2F, 1});
  expect_near(material_of("Material \"matte\" \"color Kd\" [ .1 .2 .3 ]").base_colour.value, {0.1F, 0.2F, 0.3F});
}

TEST_F(PbrtMaterials, RoughnessIsThePerceptualOne) {
  // Remapped: alpha = sqrt(0.0625) = 0.25, ours is its root.
  EXPECT_NEAR(material_of("Material \"dielectric\" \"float roughness\" .0625").roughness.value, 0.5F, 1e-6F);
  EXPECT_NEAR(material_of("Material \"dielectric\" \"float roughness\" .25 \"bool remaproughness\" false").roughness.value, 0.5F, 1e-6F);
  EXPECT_NEAR(material_of("Material \"conductor\" \"float uroughness\" .2 \"float vroughness\" .3 \"bool remaproughness\" [ false ]")
                  .roughness.value,
              0.5F, 1e-6F);
  EXPECT_EQ(material_of("Material \"coateddiffuse\"").roughness.value, 0.0F);
}

TEST_F(PbrtMaterials, RoughnessTexturesAreRemappedToo) {
  write_pfm();
  const Scene scene = load_material(
      "Texture \"r\" \"float\" \"imagemap\" \"string filename\" \"two.pfm\" \"float scale\" 0.5\n"
      "Material \"conductor\" \"texture roughness\" \"r\" \"bool remaproughness\" false");
  const ScalarParameter roughness = material(scene).roughness;
  ASSERT_NE(roughness.texture, kNoTexture);
  const Texture& texture = scene.textures.at(roughness.texture);
  const Image& image = *scene.images.at(texture.image);
  // sqrt(0.5 * 0.5) = sqrt(0.5) * sqrt(0.5).
  EXPECT_NEAR(image.floats.at(1) * texture.value[0].x, 0.5F, 1e-6F);
  EXPECT_EQ(image.floats.at(0), 0.0F);
  const Scene constants = load_material(
      "Texture \"c\" \"float\" \"checkerboard\" \"float tex1\" .0625 \"float tex2\" 0\nMaterial \"conductor\" \"texture roughness\" \"c\"");
  const Texture& board = constants.textures.at(material(constants).roughness.texture);
  EXPECT_NEAR(board.value[0].x, 0.5F, 1e-6F);
  EXPECT_EQ(board.value[1].x, 0.0F);
}

TEST_F(PbrtMaterials, Conductors) {
  const Material copper = material_of("Material \"conductor\"");
  EXPECT_TRUE(copper.has_complex_ior);
  EXPECT_LT(copper.ior_colour.x, copper.ior_colour.z);  // copper is red: it refracts blue as glass does
  const Material silver = material_of("Material \"conductor\" \"spectrum eta\" \"metal-Ag-eta\" \"spectrum k\" [ \"metal-Ag-k\" ]");
  expect_near(silver.ior_colour, {0.1279F, 0.1251F, 0.1401F});
  const Material rgb = material_of("Material \"conductor\" \"rgb eta\" [ 1 2 3 ] \"rgb k\" [ 4 5 6 ]");
  expect_near(rgb.ior_colour, {1, 2, 3});
  expect_near(rgb.absorption, {4, 5, 6});
  const Material mirror = material_of("Material \"conductor\" \"rgb reflectance\" [ .9 .8 .7 ]");
  EXPECT_FALSE(mirror.has_complex_ior);
  expect_near(mirror.base_colour.value, {0.9F, 0.8F, 0.7F});
}

TEST_F(PbrtMaterials, CoatsAndGlass) {
  const Material coated = material_of(
      "Material \"coatedconductor\" \"float interface.roughness\" .0625 \"float conductor.roughness\" 1 \"float interface.eta\" 1.7 "
      "\"spectrum conductor.eta\" \"metal-Au-eta\"");
  EXPECT_EQ(coated.kind, MaterialKind::coated_conductor);
  EXPECT_NEAR(coated.coat_roughness.value, 0.5F, 1e-6F);
  EXPECT_EQ(coated.roughness.value, 1.0F);
  EXPECT_NEAR(coated.ior, 1.7F, 1e-6F);
  expect_near(coated.ior_colour, {0.2044F, 0.3547F, 1.3798F});
  EXPECT_NEAR(material_of("Material \"dielectric\" \"spectrum eta\" \"glass-BK7\"").ior, 1.5168F, 1e-6F);
  EXPECT_NEAR(material_of("Material \"dielectric\" \"spectrum eta\" [ 500 1.6 600 1.4 ]").ior, 1.4248F, 1e-4F);
  EXPECT_NEAR(material_of("Material \"dielectric\"").ior, 1.5F, 1e-6F);
  EXPECT_EQ(material_of("Material \"thindielectric\"").kind, MaterialKind::thin_dielectric);
  EXPECT_EQ(material_of("Material \"coateddiffuse\" \"float eta\" 1.4").kind, MaterialKind::coated_diffuse);
}

TEST_F(PbrtMaterials, Interfaces) {
  for (const char* type : {"interface", "", "none"}) {
    EXPECT_EQ(material_of("Material \"" + std::string(type) + "\"").kind, MaterialKind::interface) << type;
  }
}

TEST_F(PbrtMaterials, DiffuseTransmissionIsScaled) {
  const Material m = material_of(
      "Material \"diffusetransmission\" \"rgb reflectance\" [ .2 .2 .2 ] \"rgb transmittance\" [ .4 .4 .4 ] \"float scale\" .5");
  EXPECT_EQ(m.kind, MaterialKind::diffuse_transmission);
  expect_near(m.base_colour.value, Vec3(0.1F));
  expect_near(m.transmission_colour.value, Vec3(0.2F));
}

TEST_F(PbrtMaterials, MixesNameMaterialsThatMayComeLater) {
  const Scene scene = load_material(
      "Material \"mix\" \"string materials\" [ \"a\" \"b\" ] \"float amount\" .25\n"
      "MakeNamedMaterial \"a\" \"string type\" \"conductor\"\nMakeNamedMaterial \"b\" \"string type\" \"dielectric\"");
  const Material& m = material(scene);
  EXPECT_EQ(m.kind, MaterialKind::mix);
  EXPECT_EQ(scene.materials.at(m.mix_material[0]).kind, MaterialKind::conductor);
  EXPECT_EQ(scene.materials.at(m.mix_material[1]).kind, MaterialKind::dielectric);
  EXPECT_EQ(m.mix_amount.value, 0.25F);
}

TEST_F(PbrtMaterials, NamedMaterials) {
  const Scene scene =
      load("WorldBegin MakeNamedMaterial \"m\" \"string type\" \"diffuse\" \"rgb reflectance\" [ .1 .1 .1 ] NamedMaterial \"m\"\n" +
           std::string(kTriangle) + "MakeNamedMaterial \"m\" \"string type\" \"dielectric\" NamedMaterial \"m\"\n" +
           std::string(kTriangle) + "NamedMaterial \"late\"\n" + std::string(kTriangle) +
           "MakeNamedMaterial \"late\" \"string type\" \"conductor\"\nNamedMaterial \"nowhere\"\n" + std::string(kTriangle));
  EXPECT_EQ(material(scene, 0).kind, MaterialKind::diffuse);
  EXPECT_EQ(material(scene, 1).kind, MaterialKind::dielectric);
  EXPECT_EQ(material(scene, 2).kind, MaterialKind::conductor);
  EXPECT_EQ(material(scene, 3).kind, MaterialKind::diffuse);
  EXPECT_TRUE(warns_of(scene, "no MakeNamedMaterial is called \"nowhere\""));
}

TEST_F(PbrtMaterials, HairKeepsItsColour) {
  const Scene scene = load_material("Material \"hair\" \"rgb reflectance\" [ .6 .4 .2 ]");
  expect_near(material(scene).base_colour.value, {0.6F, 0.4F, 0.2F});
  EXPECT_EQ(scene.warnings.size(), 1U);
  // No absorption is white; melanin takes blue first.
  expect_near(material_of("Material \"hair\" \"rgb sigma_a\" [ 0 0 0 ]").base_colour.value, Vec3(1.0F));
  const Vec3 blond = material_of("Material \"hair\" \"float eumelanin\" .2").base_colour.value;
  EXPECT_GT(blond.x, blond.y);
  EXPECT_GT(blond.y, blond.z);
}

TEST_F(PbrtMaterials, UnknownMaterialsAndParametersWarn) {
  const Scene scene = load_material("Material \"subsurface\" \"rgb reflectance\" [ .6 .4 .2 ] \"float mfp\" 2");
  expect_near(material(scene).base_colour.value, {0.6F, 0.4F, 0.2F});
  EXPECT_TRUE(warns_of(scene, "scene.pbrt:2: the material \"subsurface\" is not supported"));
  EXPECT_TRUE(
      warns_of(load_material("Material \"diffuse\" \"float shininess\" 2"), "scene.pbrt:2: the material \"diffuse\" has no parameter"));
}

TEST_F(PbrtMaterials, AttributeDefaultsAndColourSpaces) {
  const Scene scene = load("WorldBegin AttributeBegin Attribute \"material\" \"rgb reflectance\" [ .1 .2 .3 ] Material \"diffuse\"\n" +
                           std::string(kTriangle) + "Material \"diffuse\" \"rgb reflectance\" [ 1 1 1 ]\n" + std::string(kTriangle) +
                           "AttributeEnd ColorSpace \"rec2020\" Material \"conductor\" \"rgb eta\" [ 1 1 1 ] \"rgb k\" [ 0 1 0 ]\n" +
                           std::string(kTriangle));
  expect_near(material(scene, 0).base_colour.value, {0.1F, 0.2F, 0.3F});
  expect_near(material(scene, 1).base_colour.value, Vec3(1.0F));
  expect_near(material(scene, 2).ior_colour, Vec3(1.0F), 1e-4F);       // white stays white
  expect_near(material(scene, 2).absorption, {0, 1.1329F, 0}, 1e-4F);  // out of gamut, cut at 0
}

TEST_F(PbrtMaterials, SpectraBecomeColours) {
  expect_near(material_of("Material \"diffuse\" \"spectrum reflectance\" [ 400 .3 700 .3 ]").base_colour.value, Vec3(0.3F), 1e-3F);
  const Vec3 red = material_of("Material \"diffuse\" \"spectrum reflectance\" [ 360 0 590 0 610 1 830 1 ]").base_colour.value;
  EXPECT_GT(red.x, 0.6F);
  EXPECT_LT(red.z, 0.01F);
  write("grey.spd", "# a comment\n400 0.25\n700 0.25\n");
  expect_near(material_of("Material \"diffuse\" \"spectrum reflectance\" \"grey.spd\"").base_colour.value, Vec3(0.25F), 1e-3F);
}

TEST_F(PbrtMaterials, AlphaMakesACopy) {
  const Scene scene = load(
      "WorldBegin Texture \"a\" \"float\" \"constant\" \"float value\" .5\n"
      "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"texture alpha\" \"a\"\n"
      "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"float alpha\" .25\n" +
      std::string(kTriangle));
  EXPECT_EQ(material(scene, 0).alpha_mode, AlphaMode::blend);
  EXPECT_NE(material(scene, 0).alpha.texture, kNoTexture);
  EXPECT_EQ(material(scene, 0).alpha.channel, 0U);
  EXPECT_EQ(material(scene, 1).alpha.value, 0.25F);
  EXPECT_EQ(material(scene, 2).alpha_mode, AlphaMode::opaque);
  // A texture needs coordinates: pbrt's are (0, 0), (1, 0), (1, 1).
  ASSERT_EQ(scene.objects[0].parts[0].uvs.size(), 3U);
  EXPECT_EQ(scene.objects[0].parts[0].uvs[2], Vec2(1, 1));
  EXPECT_TRUE(scene.objects[0].parts[2].uvs.empty());
}

TEST_F(PbrtMaterials, ImageTextures) {
  write_pfm();
  const Scene scene = load_material(
      "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"two.pfm\" \"float uscale\" 2 \"float vscale\" 3 \"float vdelta\" .25 "
      "\"string wrap\" \"clamp\" \"string filter\" \"point\" \"float scale\" .5\n"
      "Texture \"u\" \"float\" \"imagemap\" \"string filename\" \"two.pfm\"\n"
      "Texture \"unused\" \"float\" \"imagemap\" \"string filename\" \"missing.png\"\n"
      "Material \"diffuse\" \"texture reflectance\" \"t\" \"texture displacement\" \"u\"");
  const Texture& t = scene.textures.at(material(scene).base_colour.texture);
  EXPECT_EQ(t.kind, TextureKind::image);
  EXPECT_FALSE(t.invert);
  EXPECT_FALSE(t.srgb);  // floats are linear
  EXPECT_EQ(t.wrap_u, TextureWrap::clamp);
  EXPECT_EQ(t.filter, TextureFilter::nearest);
  EXPECT_EQ(t.value[0].x, 0.5F);
  // pbrt's v = 0 is the bottom row: (u, v) = (0.5, 0.25) looks at (1, 1 - (3 * 0.25 + 0.25)).
  expect_near(t.uv_transform * Vec3(0.5F, 0.25F, 1), {1, 0, 1});
  expect_near(material(scene).base_colour.value, Vec3(1.0F));
  EXPECT_NE(material(scene).bump.texture, kNoTexture);
  EXPECT_EQ(material(scene).bump.value, 1.0F);
  EXPECT_EQ(scene.images.size(), 1U);  // shared; what nobody uses is not read
  EXPECT_EQ(scene.textures.size(), 2U);
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
}

TEST_F(PbrtMaterials, MissingImagesTurnGrey) {
  const Scene scene = load_material(
      "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"missing.png\"\nMaterial \"diffuse\" \"texture reflectance\" \"t\"");
  const Texture& t = scene.textures.at(material(scene).base_colour.texture);
  EXPECT_EQ(t.kind, TextureKind::constant);
  EXPECT_EQ(t.value[0].x, 0.5F);
  EXPECT_TRUE(warns_of(scene, "missing.png"));
}

TEST_F(PbrtMaterials, TexturesOfTextures) {
  const Scene scene = load_material(
      "Texture \"c\" \"spectrum\" \"constant\" \"rgb value\" [ .1 .2 .3 ]\nTexture \"f\" \"float\" \"constant\" \"float value\" .5\n"
      "Texture \"s\" \"spectrum\" \"scale\" \"texture tex\" \"c\" \"float scale\" 2\n"
      "Texture \"m\" \"spectrum\" \"mix\" \"texture tex1\" \"s\" \"rgb tex2\" [ 1 1 1 ] \"texture amount\" \"f\"\n"
      "Texture \"b\" \"spectrum\" \"checkerboard\" \"texture tex1\" \"m\" \"rgb tex2\" [ 0 .5 1 ] \"float uscale\" 4\n"
      "Material \"diffuse\" \"texture reflectance\" \"b\"");
  const Texture& b = scene.textures.at(material(scene).base_colour.texture);
  EXPECT_EQ(b.kind, TextureKind::checkerboard);
  EXPECT_EQ(b.value[1], Vec4(0, 0.5F, 1, 1));
  expect_near(b.uv_transform * Vec3(0.5F, 0.25F, 1), {2, 0.25F, 1});  // no turn-over: there is no image
  const Texture& m = scene.textures.at(b.operand[0]);
  EXPECT_EQ(m.kind, TextureKind::mix);
  EXPECT_EQ(scene.textures.at(m.amount_texture).value[0].x, 0.5F);
  const Texture& s = scene.textures.at(m.operand[0]);
  EXPECT_EQ(s.kind, TextureKind::scale);
  EXPECT_EQ(s.value[1].x, 2.0F);
  EXPECT_EQ(scene.textures.at(s.operand[0]).value[0], Vec4(0.1F, 0.2F, 0.3F, 1));
}

TEST_F(PbrtMaterials, UnsupportedTexturesTakeTheirMiddle) {
  const Scene scene = load_material(
      "Texture \"d\" \"spectrum\" \"dots\" \"rgb inside\" [ 1 0 0 ] \"rgb outside\" [ 0 0 1 ]\nMaterial \"diffuse\" \"texture "
      "reflectance\" \"d\"");
  EXPECT_EQ(scene.textures.at(material(scene).base_colour.texture).value[0], Vec4(0.5F, 0, 0.5F, 1));
  EXPECT_TRUE(warns_of(scene, "scene.pbrt:2: the texture kind \"dots\" is not supported"));
  const Scene self =
      load_material("Texture \"x\" \"float\" \"scale\" \"texture tex\" \"x\"\nMaterial \"diffuse\" \"texture displacement\" \"x\"");
  EXPECT_TRUE(warns_of(self, "no Texture before this line is called \"x\""));
}

TEST_F(PbrtMaterials, InvertedImages) {
  write_pfm();
  const Scene scene = load_material(
      "Texture \"t\" \"float\" \"imagemap\" \"string filename\" \"two.pfm\" \"bool invert\" true \"float scale\" 3\n"
      "Material \"diffuse\" \"texture reflectance\" \"t\"\n" +
      std::string(kTriangle) + "Material \"dielectric\" \"texture roughness\" \"t\" \"bool remaproughness\" false");
  const Texture& t = scene.textures.at(material(scene).base_colour.texture);
  EXPECT_TRUE(t.invert);
  EXPECT_EQ(t.value[0].x, 1.0F);
  EXPECT_TRUE(warns_of(scene, "\"scale\" of a texture with \"invert\" is left out"));
  // The picture is 0 and 0.5; the roots of their inverses are baked.
  const Texture& rough = scene.textures.at(material(scene, 1).roughness.texture);
  EXPECT_FALSE(rough.invert);
  EXPECT_EQ(scene.images.at(rough.image)->floats.at(0), 1.0F);
  EXPECT_NEAR(scene.images.at(rough.image)->floats.at(1), std::sqrt(0.5F), 1e-6F);
}

TEST_F(PbrtMaterials, EightBitEncodings) {
  // A grey TGA of 1 x 1 pixel with the value 128.
  write("grey.tga", std::string("\0\0\3\0\0\0\0\0\0\0\0\0\1\0\1\0\10\0\200", 19));
  const auto load_encoded = [&](const std::string& encoding) {
    return load_material("Texture \"t\" \"float\" \"imagemap\" \"string filename\" \"grey.tga\" " + encoding +
                         "\nMaterial \"diffuse\" \"texture reflectance\" \"t\"");
  };
  EXPECT_TRUE(load_encoded("").textures.at(0).srgb);
  EXPECT_FALSE(load_encoded("\"string encoding\" \"linear\"").textures.at(0).srgb);
  const Scene gamma = load_encoded("\"string encoding\" \"gamma 2\"");
  EXPECT_FALSE(gamma.textures.at(0).srgb);
  EXPECT_NEAR(gamma.images.at(gamma.textures[0].image)->floats.at(0), (128.0F / 255.0F) * (128.0F / 255.0F), 1e-6F);
}

TEST_F(PbrtMaterials, TexturesThatGrowWithoutEndAreCut) {
  std::string text = "Texture \"t0\" \"float\" \"constant\" \"float value\" .9\n";
  for (int i = 1; i <= 60; ++i) {
    const std::string below = "\"t" + std::to_string(i - 1) + "\"";
    text += "Texture \"t" + std::to_string(i) + "\" \"float\" \"scale\" \"texture tex\" " + below + " \"texture scale\" " + below + "\n";
  }
  const Scene scene = load_material(text + "Material \"diffuse\" \"texture displacement\" \"t60\"");
  EXPECT_TRUE(warns_of(scene, "more than 1024 others"));
}

}  // namespace
}  // namespace grove
