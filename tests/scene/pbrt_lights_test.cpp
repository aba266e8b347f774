#include <cmath>
#include <cstring>
#include <vector>

#include "scene/pbrt_file.h"

// Lights in pbrt-v4's units.

namespace grove {
namespace {

class PbrtLights : public PbrtTest {
 protected:
  static float luminance(const Vec3& c) { return 0.2126F * c.x + 0.7152F * c.y + 0.0722F * c.z; }

  void write_pfm(const std::string& name, int width, int height, const std::vector<Vec3>& pixels) const {
    std::string text = "PF\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1.0\n";
    // The rows of a PFM go from the bottom up.
    for (int y = height - 1; y >= 0; --y) {
      for (int x = 0; x < width; ++x) {
        char bytes[sizeof(Vec3)];
        std::memcpy(bytes, &pixels[static_cast<std::size_t>(y * width + x)], sizeof bytes);
        text.append(bytes, sizeof bytes);
      }
    }
    write(name, text);
  }
};

TEST_F(PbrtLights, AreaLightsEmitOnTheSideOfTheNormal) {
  const Scene scene =
      load("WorldBegin AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [ 1 2 3 ] \"float scale\" 2\n" + std::string(kTriangle) +
           "AttributeEnd\n" + std::string(kTriangle) + "AreaLightSource \"diffuse\" \"bool twosided\" true\n" + std::string(kTriangle));
  expect_near(material(scene, 0).emission.value, {2, 4, 6});
  EXPECT_FALSE(material(scene, 0).two_sided_emission);
  EXPECT_FALSE(material(scene, 1).is_emissive());
  expect_near(material(scene, 2).emission.value, Vec3(1.0F));
  EXPECT_TRUE(material(scene, 2).two_sided_emission);
}

TEST_F(PbrtLights, BlackBodiesHaveLuminanceOne) {
  const Scene scene = load("WorldBegin AreaLightSource \"diffuse\" \"blackbody L\" 3000 \"float scale\" 5\n" + std::string(kTriangle) +
                           "AreaLightSource \"diffuse\" \"blackbody L\" 6504\n" + std::string(kTriangle));
  const Vec3 warm = material(scene, 0).emission.value;
  EXPECT_NEAR(luminance(warm), 5.0F, 0.05F);
  // The chromaticity of 3000 K is (0.4369, 0.4041), which is (1.77, 0.84, 0.27) at luminance 1.
  expect_near(warm / 5.0F, {1.77F, 0.84F, 0.27F}, 0.04F);
  // At 6504 K a black body is nearly the white point D65.
  expect_near(material(scene, 1).emission.value, Vec3(1.0F), 0.06F);
}

TEST_F(PbrtLights, IlluminantSpectraAreScaledToLuminanceOne) {
  const Scene scene = load("WorldBegin AreaLightSource \"diffuse\" \"spectrum L\" [ 400 7 700 7 ]\n" + std::string(kTriangle) +
                           "AreaLightSource \"diffuse\" \"spectrum L\" \"stdillum-D65\"\n" + std::string(kTriangle));
  EXPECT_NEAR(luminance(material(scene, 0).emission.value), 1.0F, 0.01F);
  expect_near(material(scene, 1).emission.value, Vec3(1.0F), 1e-3F);
}

TEST_F(PbrtLights, Distant) {
  const Scene scene = load_world(
      "Rotate 90 1 0 0 LightSource \"distant\" \"rgb L\" [ 1 2 3 ] \"float scale\" 2 \"point3 from\" [ 0 3 0 ] \"point3 to\" [ 0 1 0 ]\n"
      "LightSource \"distant\" \"float illuminance\" 4");
  ASSERT_EQ(scene.lights.size(), 2U);
  EXPECT_EQ(scene.lights[0].kind, PunctualLightKind::directional);
  expect_near(scene.lights[0].direction, {0, 0, -1});  // -y turned about x
  expect_near(scene.lights[0].intensity, {2, 4, 6});
  expect_near(scene.lights[1].direction, {0, -1, 0});  // by default along +z
  expect_near(scene.lights[1].intensity, Vec3(4.0F));
}

TEST_F(PbrtLights, PointAndSpot) {
  const Scene scene = load_world(
      "Translate 1 2 3 Scale 2 2 2 LightSource \"point\" \"rgb I\" [ 1 1 2 ] \"point3 from\" [ 1 0 0 ]\n"
      "LightSource \"spot\" \"float coneangle\" 40 \"float conedeltaangle\" 10 \"point3 to\" [ 1 0 0 ] \"rgb I\" [ 3 3 3 ]\n"
      "LightSource \"point\" \"float power\" 12.566371");
  ASSERT_EQ(scene.lights.size(), 3U);
  expect_near(scene.lights[0].position, {3, 2, 3});
  expect_near(scene.lights[0].intensity, {1, 1, 2});
  EXPECT_EQ(scene.lights[1].kind, PunctualLightKind::spot);
  expect_near(scene.lights[1].direction, {1, 0, 0});
  EXPECT_NEAR(scene.lights[1].outer_angle, 40.0F * kPi / 180.0F, 1e-5F);
  EXPECT_NEAR(scene.lights[1].inner_angle, 30.0F * kPi / 180.0F, 1e-5F);
  expect_near(scene.lights[2].intensity, Vec3(1.0F), 1e-5F);
}

TEST_F(PbrtLights, PicturesOfPointLightsAreLeftOut) {
  const Scene scene =
      load_world("LightSource \"goniometric\" \"string filename\" \"none.exr\" LightSource \"projection\" LightSource \"laser\"");
  EXPECT_EQ(scene.lights.size(), 2U);
  EXPECT_EQ(scene.warnings.size(), 3U);
}

TEST_F(PbrtLights, ConstantEnvironmentsAddUp) {
  const Scene scene = load_world(
      "LightSource \"infinite\" \"rgb L\" [ 1 2 3 ] \"float scale\" .5 LightSource \"infinite\" \"float illuminance\" 3.1415927");
  expect_near(scene.environment.radiance, {1.5F, 2, 2.5F});
  EXPECT_EQ(scene.environment.image, 0xffffffffU);
}

TEST_F(PbrtLights, OctahedralEnvironmentsKeepTheirPixelsAndTurn) {
  write_pfm("sky.pfm", 2, 2, std::vector<Vec3>(4, Vec3(1.0F)));
  const Scene scene = load_world("Scale 3 3 3 Rotate 90 0 0 1 LightSource \"infinite\" \"string filename\" \"sky.pfm\" \"float scale\" 2");
  EXPECT_EQ(scene.environment.mapping, EnvironmentMapping::octahedral);
  EXPECT_EQ(scene.images.at(scene.environment.image)->width, 2U);
  expect_near(scene.environment.radiance, Vec3(2.0F));
  // The light's +x lies along the world's +y.
  expect_near(scene.environment.world_to_environment * Vec3(0, 1, 0), {1, 0, 0});
}

TEST_F(PbrtLights, LatitudeLongitudeEnvironmentsAreResampled) {
  // The upper half red and the lower blue; in the upper half azimuth 0 to 180 degrees is green too.
  std::vector<Vec3> pixels;
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) pixels.push_back(y < 16 ? Vec3(1.0F, x < 32 ? 1.0F : 0.0F, 0.0F) : Vec3(0.0F, 0.0F, 1.0F));
  }
  write_pfm("sky.pfm", 64, 32, pixels);
  const Scene scene = load_world("LightSource \"infinite\" \"string filename\" \"sky.pfm\"");
  const Image& image = *scene.images.at(scene.environment.image);
  ASSERT_EQ(image.width, image.height);
  const auto at = [&](float u, float v) {
    const auto x = static_cast<std::size_t>(u * static_cast<float>(image.width)),
               y = static_cast<std::size_t>(v * static_cast<float>(image.height));
    const float* p = &image.floats[3 * (y * image.width + x)];
    return Vec3(p[0], p[1], p[2]);
  };
  // +z is the middle of the square, +y lies toward larger v, -z in the corners.
  expect_near(at(0.5F, 0.65F), {1, 1, 0}, 0.01F);
  expect_near(at(0.5F, 0.35F), {1, 0, 0}, 0.01F);
  expect_near(at(0.02F, 0.02F), {0, 0, 1}, 0.01F);
  EXPECT_TRUE(warns_of(scene, "latitude and longitude"));
}

TEST_F(PbrtLights, IlluminanceOfAnEnvironmentImage) {
  // Radiance 2 from everywhere lights a patch with 2 pi; asked for is pi.
  write_pfm("sky.pfm", 32, 32, std::vector<Vec3>(1024, Vec3(2.0F)));
  const Scene scene = load_world("LightSource \"infinite\" \"string filename\" \"sky.pfm\" \"float illuminance\" 3.1415927");
  expect_near(scene.environment.radiance, Vec3(0.5F), 2e-3F);
}

TEST_F(PbrtLights, EnvironmentsOfOtherShapesAreRefused) {
  write_pfm("sky.pfm", 3, 1, std::vector<Vec3>(3, Vec3(2.0F)));
  EXPECT_NE(error_of("WorldBegin\nLightSource \"infinite\" \"string filename\" \"sky.pfm\"\n" + std::string(kTriangle))
                .find("scene.pbrt:2: the environment"),
            std::string::npos);
}

}  // namespace
}  // namespace grove
