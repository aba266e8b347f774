#include <gtest/gtest.h>

#include <cmath>

#include "grove/base/random.h"
#include "grove/render/material/material_table.h"
#include "grove/render/material/opacity.h"
#include "grove/render/texture/evaluate_texture.h"
#include "test_scenes.h"

namespace grove {
namespace {

// Four texels: red, green above blue, white (half transparent).
Scene image_scene() {
  auto image = std::make_shared<Image>();
  image->width = image->height = 2;
  image->channels = 4;
  image->bytes = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 128};
  Scene scene;
  scene.images.push_back(image);
  Texture texture;
  texture.kind = TextureKind::image;
  texture.image = 0;
  texture.filter = TextureFilter::nearest;
  scene.textures.push_back(texture);
  return scene;
}

TEST(Texture, FirstRowIsOnTopAtVZero) {
  const Scene scene = image_scene();
  EXPECT_EQ(evaluate_texture(scene, 0, {0.25F, 0.25F}), Vec4(1, 0, 0, 1));
  EXPECT_EQ(evaluate_texture(scene, 0, {0.75F, 0.25F}), Vec4(0, 1, 0, 1));
  EXPECT_EQ(evaluate_texture(scene, 0, {0.25F, 0.75F}), Vec4(0, 0, 1, 1));
  EXPECT_EQ(evaluate_texture(scene, kNoTexture, {0.25F, 0.75F}), Vec4(1.0F));
}

TEST(Texture, WrapsFourWays) {
  Scene scene = image_scene();
  Texture& texture = scene.textures[0];
  const Vec2 right(1.25F, 0.25F);  // one texel beyond
  texture.wrap_u = TextureWrap::repeat;
  EXPECT_EQ(evaluate_texture(scene, 0, right), Vec4(1, 0, 0, 1));
  EXPECT_EQ(evaluate_texture(scene, 0, {-0.25F, 0.25F}), Vec4(0, 1, 0, 1));
  texture.wrap_u = TextureWrap::mirror;
  EXPECT_EQ(evaluate_texture(scene, 0, right), Vec4(0, 1, 0, 1));
  EXPECT_EQ(evaluate_texture(scene, 0, {-0.25F, 0.25F}), Vec4(1, 0, 0, 1));
  texture.wrap_u = TextureWrap::clamp;
  EXPECT_EQ(evaluate_texture(scene, 0, {3.9F, 0.25F}), Vec4(0, 1, 0, 1));
  texture.wrap_u = TextureWrap::black;
  EXPECT_EQ(evaluate_texture(scene, 0, right), Vec4(0.0F));
}

TEST(Texture, FiltersAfterDecodingAndLeavesAlphaAlone) {
  Scene scene = image_scene();
  scene.textures[0].filter = TextureFilter::linear;
  const Vec4 middle = evaluate_texture(scene, 0, {0.5F, 0.5F});
  EXPECT_NEAR(middle.x, 0.5F, 1e-6F);
  EXPECT_NEAR(middle.w, (3.0F + 128.0F / 255.0F) / 4.0F, 1e-6F);
  auto grey = std::make_shared<Image>();
  grey->width = grey->height = 1;
  grey->channels = 2;
  grey->bytes = {188, 188};
  scene.images[0] = grey;
  scene.textures[0].srgb = true;
  const Vec4 value = evaluate_texture(scene, 0, {0.5F, 0.5F});
  EXPECT_NEAR(value.y, 0.5029F, 1e-3F);
  EXPECT_NEAR(value.w, 188.0F / 255.0F, 1e-6F);
  scene.textures[0].invert = true;
  EXPECT_NEAR(evaluate_texture(scene, 0, {0.5F, 0.5F}).y, 1.0F - 0.5029F, 1e-3F);
}

// What is read of one channel is what the whole has there, for each number of channels, of bytes and of floats.
TEST(Texture, OneChannelIsThatOfTheWhole) {
  Random random(11);
  Scene scene = image_scene();
  for (std::uint32_t channels = 1; channels <= 4; ++channels) {
    for (const bool is_float : {false, true}) {
      auto image = std::make_shared<Image>();
      image->width = 3;
      image->height = 2;
      image->channels = channels;
      image->bytes.resize(is_float ? 0 : 6 * channels);
      image->floats.resize(is_float ? 6 * channels : 0);
      for (auto& byte : image->bytes) byte = static_cast<std::uint8_t>(random.next_u32(256));
      for (float& value : image->floats) value = random.next_float();
      scene.images[0] = image;
      Texture& texture = scene.textures[0];
      texture.srgb = channels % 2 == 0;
      texture.invert = channels == 3;
      texture.wrap_v = TextureWrap::black;
      texture.filter = TextureFilter::linear;
      for (int i = 0; i < 20; ++i) {
        const Vec2 uv(random.next_float(-2.0F, 2.0F), random.next_float(-0.5F, 1.5F));
        const Vec4 whole = evaluate_texture(scene, 0, uv);
        for (std::uint32_t c = 0; c < 4; ++c)
          EXPECT_EQ(evaluate(scene, ScalarParameter{1.0F, 0, c}, uv), whole[static_cast<int>(c)]) << channels << " channels, channel " << c;
      }
    }
  }
}

TEST(Texture, CombinesOperands) {
  Scene scene = image_scene();
  Texture checker;
  checker.kind = TextureKind::checkerboard;
  checker.operand[0] = 0;
  checker.value[1] = Vec4(0.5F);
  checker.uv_transform = Mat3(Vec3(4, 0, 0), Vec3(0, 4, 0), Vec3(0, 0, 1));
  scene.textures.push_back(checker);
  EXPECT_EQ(evaluate_texture(scene, 1, {0.1F, 0.1F}), Vec4(1, 0, 0, 1));
  EXPECT_EQ(evaluate_texture(scene, 1, {0.3F, 0.1F}), Vec4(0.5F));
  EXPECT_EQ(evaluate_texture(scene, 1, {-0.1F, 0.1F}), Vec4(0.5F));
  Texture mix;
  mix.kind = TextureKind::mix;
  mix.operand[0] = 1;
  mix.value[1] = Vec4(0.0F);
  mix.amount = 0.25F;
  scene.textures.push_back(mix);
  EXPECT_NEAR(evaluate_texture(scene, 2, {0.3F, 0.1F}).x, 0.375F, 1e-6F);
  Texture scale = mix;
  scale.kind = TextureKind::scale;
  scale.value[1] = Vec4(3.0F);
  scene.textures.push_back(scale);
  EXPECT_NEAR(evaluate_texture(scene, 3, {0.3F, 0.1F}).x, 1.5F, 1e-6F);
}

TEST(Texture, SurvivesBadCoordinatesAndImages) {
  Scene scene = image_scene();
  for (const float bad : {INFINITY, -INFINITY, std::nanf(""), 1e30F}) {
    const Vec4 value = evaluate_texture(scene, 0, {bad, 0.5F});
    EXPECT_TRUE(std::isfinite(value.x + value.y + value.z + value.w));
  }
  scene.images[0] = std::make_shared<Image>();
  EXPECT_EQ(evaluate_texture(scene, 0, {0.5F, 0.5F}), Vec4(0.0F));
}

TEST(Opacity, FollowsModeCutoffVertexColourAndMix) {
  Scene scene;
  SurfaceCoordinates place;
  Material material = testing::SceneMaker::diffuse(Vec3(0.5F));
  material.alpha.value = 0.4F;
  EXPECT_EQ(opacity(scene, material, place), 1.0F);
  EXPECT_FALSE(can_pass_light(scene, material));
  material.alpha_mode = AlphaMode::blend;
  EXPECT_FLOAT_EQ(opacity(scene, material, place), 0.4F);
  place.colour_alpha = 0.5F;
  EXPECT_FLOAT_EQ(opacity(scene, material, place), 0.2F);
  material.alpha_mode = AlphaMode::mask;
  EXPECT_EQ(opacity(scene, material, place), 0.0F);
  material.alpha_cutoff = 0.1F;
  EXPECT_EQ(opacity(scene, material, place), 1.0F);
  Material nothing;
  nothing.kind = MaterialKind::interface;
  scene.materials = {material, nothing};
  Material mix;
  mix.kind = MaterialKind::mix;
  mix.mix_material[0] = 0;
  mix.mix_material[1] = 1;
  mix.mix_amount.value = 0.25F;
  EXPECT_FLOAT_EQ(opacity(scene, mix, place), 0.75F);
  EXPECT_TRUE(can_pass_light(scene, mix));
}

// The material of a mix is chosen in proportion, and what lets all light pass is never what scatters.
TEST(MaterialTable, MixesInProportion) {
  Scene scene;
  scene.materials.resize(3);
  scene.materials[0] = testing::SceneMaker::diffuse(Vec3(0.2F));
  scene.materials[1] = testing::SceneMaker::diffuse(Vec3(0.8F));
  scene.materials[2].kind = MaterialKind::mix;
  scene.materials[2].mix_material[1] = 1;
  scene.materials[2].mix_amount.value = 0.3F;
  SurfacePoint point;
  point.material = 2;
  const auto count_second = [&] {
    const MaterialTable table(scene);
    int second = 0;
    for (int i = 0; i < 1000; ++i) {
      if (table.bsdf(point, {}, (static_cast<float>(i) + 0.5F) / 1000.0F).albedo({0, 0, 1}).x > 0.5F) ++second;
    }
    return second;
  };
  EXPECT_EQ(count_second(), 300);
  scene.materials[0].kind = MaterialKind::interface;
  EXPECT_EQ(count_second(), 1000);
}

}  // namespace
}  // namespace grove
