#include "grove/render/bsdf/bsdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "bsdf_models.h"
#include "grove/base/random.h"
#include "grove/render/sampling/warp.h"
#include "statistics.h"

namespace grove {
namespace {

using testing::NamedBsdf;

constexpr std::uint64_t kSeed = 74211;

Vec3 direction(float degrees, float azimuth = 0.6F) {
  const float angle = degrees * kPi / 180.0F;
  return {std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth), std::cos(angle)};
}

class BsdfModel : public ::testing::TestWithParam<NamedBsdf> {};

class SpreadingBsdfModel : public BsdfModel {};

// Those that do not scatter into single directions only.
std::vector<NamedBsdf> spreading_models() {
  std::vector<NamedBsdf> models = testing::all_models();
  std::erase_if(models, [](const NamedBsdf& model) { return model.bsdf.is_delta(); });
  return models;
}

INSTANTIATE_TEST_SUITE_P(All, SpreadingBsdfModel, ::testing::ValuesIn(spreading_models()),
                         [](const auto& model) { return model.param.name; });
INSTANTIATE_TEST_SUITE_P(All, BsdfModel, ::testing::ValuesIn(testing::all_models()), [](const auto& model) { return model.param.name; });

// Directions are binned by azimuth and cosine over the whole sphere.
constexpr int kAzimuths = 24;
constexpr int kCosines = 32;

// The density integrated over each bin, by midpoints; `total` is over all.
std::vector<double> bin_masses(const Bsdf& bsdf, const Vec3& wo, double& total) {
  constexpr int kSub = 12;
  std::vector<double> masses(kAzimuths * kCosines);
  total = 0.0;
  for (int c = 0; c < kCosines; ++c) {
    for (int a = 0; a < kAzimuths; ++a) {
      double sum = 0.0;
      for (int i = 0; i < kSub * kSub; ++i) {
        const float cosine = -1.0F + 2.0F * (static_cast<float>(c) + (static_cast<float>(i / kSub) + 0.5F) / kSub) / kCosines;
        const float azimuth = 2.0F * kPi * (static_cast<float>(a) + (static_cast<float>(i % kSub) + 0.5F) / kSub) / kAzimuths;
        const float sine = std::sqrt(1.0F - cosine * cosine);
        sum += static_cast<double>(bsdf.evaluate(wo, {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine}).pdf);
      }
      const double mass = sum / (kSub * kSub) * 4.0 * static_cast<double>(kPi) / (kAzimuths * kCosines);
      masses[static_cast<std::size_t>(c * kAzimuths + a)] = mass;
      total += mass;
    }
  }
  return masses;
}

std::size_t bin_of(const Vec3& w) {
  float azimuth = std::atan2(w.y, w.x);
  if (azimuth < 0.0F) azimuth += 2.0F * kPi;
  const int a = std::min(kAzimuths - 1, static_cast<int>(azimuth / (2.0F * kPi) * kAzimuths));
  const int c = std::min(kCosines - 1, static_cast<int>((w.z + 1.0F) * 0.5F * kCosines));
  return static_cast<std::size_t>(c * kAzimuths + a);
}

TEST_P(SpreadingBsdfModel, SamplesMatchTheDensity) {
  const Bsdf& bsdf = GetParam().bsdf;
  constexpr int kDraws = 40000;
  for (const float degrees : {8.0F, 50.0F, 80.0F}) {
    const Vec3 wo = direction(degrees);
    double total = 0.0;
    std::vector<double> expected = bin_masses(bsdf, wo, total);
    double peak = 0.0;
    for (double& mass : expected) {
      peak = std::max(peak, mass);
      mass *= kDraws;
    }
    Random random(kSeed);
    std::vector<double> observed(expected.size());
    double taken = 0.0;
    for (int i = 0; i < kDraws; ++i) {
      const BsdfSample sample = bsdf.sample(wo, random.next_float(), {random.next_float(), random.next_float()});
      if (!sample || sample.is_delta) continue;
      ASSERT_NEAR(glm::length(sample.wi), 1.0F, 1e-4F);
      const BsdfValue value = bsdf.evaluate(wo, sample.wi);
      ASSERT_NEAR(value.pdf, sample.pdf, 1e-3F * sample.pdf) << "seed " << kSeed << ", draw " << i;
      for (int channel = 0; channel < 3; ++channel) {
        const float tolerance = 1e-3F * sample.pdf * (1.0F + sample.weight[channel]);
        ASSERT_NEAR(value.value[channel], sample.weight[channel] * sample.pdf, tolerance) << "seed " << kSeed << ", draw " << i;
      }
      ++observed[bin_of(sample.wi)];
      ++taken;
    }
    // Narrow lobes are integrated too coarsely for a test of the bins; their masses are still right on the whole.
    if (peak > 0.08) {
      EXPECT_NEAR(total, taken / kDraws, 0.15) << degrees << " degrees";
      continue;
    }
    // What samples miss (delta lobes, directions below the surface) is missing from the density as well.
    EXPECT_LT(total, 1.01) << degrees << " degrees";
    EXPECT_NEAR(total, taken / kDraws, 0.015) << degrees << " degrees";
    EXPECT_GT(testing::chi_squared_fit(observed, expected), 1e-5) << degrees << " degrees, seed " << kSeed;
  }
}

// All the energy that comes back from a uniform white surrounding.
Vec3 white_furnace(const Bsdf& bsdf, const Vec3& wo) {
  constexpr int kSide = 96;
  Vec3 sum(0.0F);
  Random random(kSeed);
  for (int i = 0; i < kSide * kSide; ++i) {
    const Vec2 cell(static_cast<float>(i % kSide), static_cast<float>(i / kSide));
    const Vec2 u = (cell + Vec2(random.next_float(), random.next_float())) / static_cast<float>(kSide);
    const double lobe = std::fmod((i + 0.5) * 0.6180339887, 1.0);
    const BsdfSample sample = bsdf.sample(wo, static_cast<float>(lobe), u);
    if (sample) sum += sample.weight * sample.eta_squared;
  }
  return sum / static_cast<float>(kSide * kSide);
}

TEST_P(BsdfModel, CreatesNoEnergyAndLosesNoneWhenLossless) {
  const NamedBsdf& model = GetParam();
  for (const float degrees : {0.5F, 25.0F, 50.0F, 70.0F, 84.0F}) {
    const Vec3 albedo = white_furnace(model.bsdf, direction(degrees));
    for (int channel = 0; channel < 3; ++channel) {
      EXPECT_LT(albedo[channel], 1.015F) << degrees << " degrees";
      EXPECT_GE(albedo[channel], 0.0F);
      if (model.is_lossless) {
        EXPECT_GT(albedo[channel], 0.98F) << degrees << " degrees";
      }
    }
  }
}

// The others compensate for multiple scattering, which depends on wo alone.
TEST(Bsdf, ReciprocalModelsAreReciprocal) {
  int model_count = 0;
  for (const NamedBsdf& model : testing::all_models()) {
    if (!model.is_reciprocal) continue;
    ++model_count;
    Random random(kSeed);
    for (int i = 0; i < 500; ++i) {
      const Vec3 a = sample_cosine_hemisphere({random.next_float(), random.next_float()});
      const Vec3 b = sample_cosine_hemisphere({random.next_float(), random.next_float()});
      if (a.z < 0.01F || b.z < 0.01F) continue;
      const Vec3 there = model.bsdf.evaluate(a, b).value / b.z;
      const Vec3 back = model.bsdf.evaluate(b, a).value / a.z;
      for (int channel = 0; channel < 3; ++channel) {
        ASSERT_NEAR(there[channel], back[channel], 1e-3F * (1.0F + there[channel])) << model.name << ", seed " << kSeed << ", pair " << i;
      }
    }
  }
  EXPECT_GE(model_count, 5);
}

TEST_P(BsdfModel, GivesFiniteValuesEverywhere) {
  const Bsdf& bsdf = GetParam().bsdf;
  Random random(kSeed);
  for (int i = 0; i < 3000; ++i) {
    Vec3 wo = sample_cosine_hemisphere({random.next_float(), random.next_float()});
    if (i % 5 == 0) wo = direction(89.99F);
    if (i % 7 == 0) wo = {0.0F, 0.0F, 1.0F};
    wo.z = std::max(wo.z, 1e-6F);
    const Vec3 wi = i % 3 == 0 ? -wo : sample_sphere({random.next_float(), random.next_float()});
    const BsdfValue value = bsdf.evaluate(wo, wi);
    ASSERT_TRUE(std::isfinite(value.pdf) && value.pdf >= 0.0F) << "seed " << kSeed << ", draw " << i;
    ASSERT_TRUE(std::isfinite(value.value.x + value.value.y + value.value.z) && value.value.x >= 0.0F) << "draw " << i;
    const BsdfSample sample = bsdf.sample(wo, random.next_float(), {random.next_float(), random.next_float()});
    if (!sample) continue;
    ASSERT_TRUE(std::isfinite(sample.weight.x + sample.wi.x + sample.wi.y + sample.wi.z)) << "seed " << kSeed << ", draw " << i;
  }
}

// Radiance that leaves glass is lower by the square of the index than inside, so that the way in compresses it.
TEST(Dielectric, RadianceFollowsTheIndexSquared) {
  const DielectricBsdf smooth{.eta = 1.5F};
  const BsdfSample through = smooth.sample(direction(30.0F), 0.99F, {0.5F, 0.5F});
  ASSERT_TRUE(through);
  EXPECT_NEAR(through.weight.x, 1.0F / 2.25F, 1e-5F);
  // Snell: sin 30 / 1.5.
  EXPECT_NEAR(std::sqrt(1.0F - through.wi.z * through.wi.z), 0.5F / 1.5F, 1e-5F);
  EXPECT_LT(through.wi.z, 0.0F);
}

TEST(Dielectric, FresnelAgreesWithClosedForms) {
  EXPECT_EQ(fresnel_dielectric(std::cos(0.75F), 1.0F / 1.5F), 1.0F);  // 43 degrees; the critical angle is 41.8
  EXPECT_NEAR(fresnel_dielectric(1.0F, 1.5F), 0.04F, 1e-6F);
  EXPECT_NEAR(fresnel_dielectric(1.0F, 1.0F / 1.5F), 0.04F, 1e-6F);
  // Brewster's angle: the parallel part vanishes and half of the other is left.
  const float brewster = std::cos(std::atan(1.5F));
  const float perpendicular = (1.0F - 2.25F) / (1.0F + 2.25F);
  EXPECT_NEAR(fresnel_dielectric(brewster, 1.5F), 0.5F * perpendicular * perpendicular, 1e-5F);
}

TEST(Conductor, FresnelAgreesWithClosedForms) {
  const Vec3 eta(0.2F, 1.1F, 2.0F);
  const Vec3 k(3.9F, 2.6F, 0.0F);
  const Vec3 normal = fresnel_conductor(1.0F, eta, k);
  for (int c = 0; c < 3; ++c) {
    const float k2 = k[c] * k[c];
    const float expected = ((eta[c] - 1.0F) * (eta[c] - 1.0F) + k2) / ((eta[c] + 1.0F) * (eta[c] + 1.0F) + k2);
    EXPECT_NEAR(normal[c], expected, 1e-5F);
  }
  // Without absorption a metal is glass.
  for (const float cosine : {0.1F, 0.5F, 0.9F}) EXPECT_NEAR(fresnel_conductor(cosine, eta, k).z, fresnel_dielectric(cosine, 2.0F), 1e-5F);
}

// What is thrown back inside the coat meets the base again: darker and more saturated than the base alone.
TEST(CoatedDiffuse, DarkensAndSaturatesTheBase) {
  const CoatedDiffuseBsdf coated{{1.5F, 0.0F, &testing::glass_table()}, Vec3(0.5F, 0.25F, 0.1F)};
  const Vec3 base = coated.albedo({0.0F, 0.0F, 1.0F}) - Vec3(0.04F);
  EXPECT_LT(base.x, 0.5F);
  EXPECT_GT(base.x / base.z, 0.5F / 0.1F);
}

}  // namespace
}  // namespace grove
