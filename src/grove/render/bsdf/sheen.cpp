#include "grove/render/bsdf/sheen.h"

#include <algorithm>
#include <cmath>

namespace grove {
namespace {

// Table 1 of the paper: at alpha 0 and 1, interpolated by (1 - alpha)^2.
struct LambdaFit {
  float a, b, c, d, e;
};
constexpr LambdaFit kSharp{25.3245F, 3.32435F, 0.16801F, -1.27393F, -4.85967F};
constexpr LambdaFit kBroad{21.5473F, 3.82987F, 0.19823F, -1.97760F, -4.32054F};

float fitted(float x, float alpha) {
  const float share = (1.0F - alpha) * (1.0F - alpha);
  const auto mix = [share](float broad, float sharp) { return broad + (sharp - broad) * share; };
  const float power = std::pow(std::max(x, 1e-6F), mix(kBroad.c, kSharp.c));
  return mix(kBroad.a, kSharp.a) / (1.0F + mix(kBroad.b, kSharp.b) * power) + mix(kBroad.d, kSharp.d) * x + mix(kBroad.e, kSharp.e);
}

// Smith's Lambda as fitted for the distribution; symmetrical about a cosine of a half, in the exponent.
float lambda(float cosine, float alpha) {
  if (cosine < 0.5F) return std::exp(fitted(cosine, alpha));
  return std::exp(2.0F * fitted(0.5F, alpha) - fitted(1.0F - cosine, alpha));
}

constexpr std::size_t kNodes = AlbedoTable::kNodes;
// Of the hemisphere of incident light, each way; twice as many change the table by less than 2e-3.
constexpr int kCosineSteps = 48;
constexpr int kAzimuthSteps = 24;

float integrate(float cosine_o, float alpha) {
  const Vec3 wo(std::sqrt(std::max(0.0F, 1.0F - cosine_o * cosine_o)), 0.0F, cosine_o);
  double sum = 0.0;
  for (int c = 0; c < kCosineSteps; ++c) {
    const float z = (static_cast<float>(c) + 0.5F) / kCosineSteps;
    const float r = std::sqrt(1.0F - z * z);
    for (int a = 0; a < kAzimuthSteps; ++a) {
      // Half of the azimuths: the other half mirrors them.
      const float phi = kPi * (static_cast<float>(a) + 0.5F) / kAzimuthSteps;
      sum += static_cast<double>(charlie_sheen(wo, {r * std::cos(phi), r * std::sin(phi), z}, alpha) * z);
    }
  }
  return static_cast<float>(sum * 2.0 * static_cast<double>(kPi) / (kCosineSteps * kAzimuthSteps));
}

AlbedoTable make_sheen_albedo() {
  AlbedoTable table;
  for (std::size_t a = 0; a < kNodes; ++a) {
    const float alpha = std::max(AlbedoTable::node_alpha(a), kLeastSheenAlpha);
    for (std::size_t c = 0; c < kNodes; ++c) table.at(a, c) = integrate(AlbedoTable::node_cosine(c), alpha);
  }
  return table;
}

}  // namespace

float charlie_sheen(const Vec3& wo, const Vec3& wi, float alpha) {
  if (wo.z <= 0.0F || wi.z <= 0.0F) return 0.0F;
  const Vec3 half = glm::normalize(wo + wi);
  const float inverse = 1.0F / alpha;
  const float sine = std::sqrt(std::max(0.0F, half.x * half.x + half.y * half.y));
  const float distribution = (2.0F + inverse) * std::pow(sine, inverse) / (2.0F * kPi);
  const float shadowing = 1.0F / (1.0F + lambda(wo.z, alpha) + lambda(wi.z, alpha));
  return distribution * shadowing / (4.0F * wo.z * wi.z);
}

const AlbedoTable& sheen_albedo() {
  static const AlbedoTable table = make_sheen_albedo();
  return table;
}

Vec3 SheenLayer::evaluate(const Vec3& wo, const Vec3& wi) const {
  if (!exists() || wi.z <= 0.0F) return Vec3(0.0F);
  // Where the fit gives back more than comes in, at grazing angles, it is brought down to all of it.
  const float excess = std::max({1.0F, sheen_albedo()(wo.z, alpha), sheen_albedo()(wi.z, alpha)});
  return colour * (charlie_sheen(wo, wi, alpha) * wi.z / excess);
}

float SheenLayer::white_albedo(float cosine) const {
  return std::min(1.0F, sheen_albedo()(cosine, alpha));
}

float SheenLayer::scaling(float cosine_o, float cosine_i) const {
  if (!exists()) return 1.0F;
  return std::max(0.0F, 1.0F - max_component(colour) * std::max(white_albedo(cosine_o), white_albedo(cosine_i)));
}

}  // namespace grove
