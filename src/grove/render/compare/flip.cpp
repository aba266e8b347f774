#include "grove/render/compare/flip.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "grove/base/parallel.h"
#include "grove/render/compare/opponent_colours.h"

namespace grove {
namespace {

// One of the Gaussians that the contrast sensitivity of an opponent channel is the sum of (section 4.1.1): a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees.
struct Sensitivity {
  float a;
  float b;
};

constexpr Sensitivity kAchromatic{1.0F, 0.0047F};
constexpr Sensitivity kRedGreen{1.0F, 0.0053F};
constexpr Sensitivity kBlueYellow[2] = {{34.1F, 0.04F}, {13.5F, 0.025F}};

Kernel sensitivity_kernel(const Sensitivity& s, float pixels_per_degree) {
  // Three standard deviations of the widest of all, for all.
  const int radius = static_cast<int>(std::ceil(3.0F * std::sqrt(kBlueYellow[0].b / (2.0F * kPi * kPi)) * pixels_per_degree));
  Kernel kernel(radius);
  for (int i = -radius; i <= radius; ++i) {
    const float x = static_cast<float>(i) / pixels_per_degree;
    kernel.at(i) = std::exp(-kPi * kPi * x * x / s.b);
  }
  return kernel;
}

// What one opponent channel becomes to the eye. Several Gaussians share one normalisation.
Plane blurred(const Plane& plane, const ColourImage& size, std::span<const Sensitivity> parts, float pixels_per_degree) {
  float total = 0.0F;
  Plane result(plane.size(), 0.0F);
  for (const Sensitivity& part : parts) {
    const Kernel kernel = sensitivity_kernel(part, pixels_per_degree);
    const float weight = part.a * std::sqrt(kPi / part.b);
    total += weight * kernel.sum() * kernel.sum();
    const Plane convolved = convolve(plane, size.width, size.height, kernel, kernel);
    for (std::size_t i = 0; i < plane.size(); ++i) result[i] += weight * convolved[i];
  }
  for (float& value : result) value /= total;
  return result;
}

// First and second derivative of a Gaussian as wide as edges are seen (section 4.2), across, and the Gaussian itself, down.
struct FeatureKernels {
  Kernel edge;
  Kernel point;
  Kernel smooth;

  explicit FeatureKernels(float pixels_per_degree) : FeatureKernels(0.5F * kWidth * pixels_per_degree, 0) {}

 private:
  static constexpr float kWidth = 0.082F;  // degrees

  FeatureKernels(float deviation, int /*tag*/) : edge(radius(deviation)), point(radius(deviation)), smooth(radius(deviation)) {
    for (int i = -edge.radius(); i <= edge.radius(); ++i) {
      const auto x = static_cast<float>(i);
      const float gauss = std::exp(-x * x / (2.0F * deviation * deviation));
      smooth.at(i) = gauss;
      edge.at(i) = -x * gauss;
      point.at(i) = (x * x / (deviation * deviation) - 1.0F) * gauss;
    }
    smooth.scale(1.0F / smooth.sum());
    balance(edge);
    balance(point);
  }

  static int radius(float deviation) { return static_cast<int>(std::ceil(3.0F * deviation)); }

  // Positive weights sum to 1 and negative ones to -1.
  static void balance(Kernel& kernel) {
    float positive = 0.0F;
    float negative = 0.0F;
    for (const float weight : kernel.weights) (weight > 0.0F ? positive : negative) += weight;
    for (float& weight : kernel.weights) weight /= weight > 0.0F ? positive : -negative;
  }
};

// How strongly each pixel is an edge or a point.
Plane feature_strength(const Plane& lightness, const ColourImage& size, const Kernel& feature, const Kernel& smooth) {
  const Plane across = convolve(lightness, size.width, size.height, feature, smooth);
  Plane result = convolve(lightness, size.width, size.height, smooth, feature);
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = std::sqrt(across[i] * across[i] + result[i] * result[i]);
  return result;
}

// A picture as the metric sees it.
struct Seen {
  std::vector<Vec3> colours;  // blurred, in Hunt-adjusted CIELAB
  Plane edges;
  Plane points;
};

Seen look_at_picture(const ColourImage& image, float pixels_per_degree) {
  const std::size_t count = image.pixels.size();
  Plane channels[3] = {Plane(count), Plane(count), Plane(count)};
  Plane lightness(count);
  parallel_for(count, 4096, [&](std::size_t i) {
    const Vec3& colour = image.pixels[i];
    Vec3 shown;
    // A NaN is shown as black.
    for (int c = 0; c < 3; ++c) shown[c] = colour[c] > 0.0F ? std::min(colour[c], 1.0F) : 0.0F;
    const Vec3 opponent = to_ycxcz(shown);
    for (int c = 0; c < 3; ++c) channels[c][i] = opponent[c];
    lightness[i] = (opponent.x + 16.0F) / 116.0F;
  });
  const FeatureKernels kernels(pixels_per_degree);
  Seen seen;
  seen.edges = feature_strength(lightness, image, kernels.edge, kernels.smooth);
  seen.points = feature_strength(lightness, image, kernels.point, kernels.smooth);
  const Plane achromatic = blurred(channels[0], image, {&kAchromatic, 1}, pixels_per_degree);
  const Plane red_green = blurred(channels[1], image, {&kRedGreen, 1}, pixels_per_degree);
  const Plane blue_yellow = blurred(channels[2], image, kBlueYellow, pixels_per_degree);
  seen.colours.resize(count);
  parallel_for(count, 4096, [&](std::size_t i) {
    const Vec3 colour = from_ycxcz({achromatic[i], red_green[i], blue_yellow[i]});
    seen.colours[i] = to_hunt_lab(glm::clamp(colour, Vec3(0.0F), Vec3(1.0F)));
  });
  return seen;
}

// Compresses large colour differences and maps them to [0, 1] (section 4.1.3).
class ColourDifference {
 public:
  ColourDifference() : largest_(std::pow(hyab(to_hunt_lab({0.0F, 1.0F, 0.0F}), to_hunt_lab({0.0F, 0.0F, 1.0F})), kExponent)) {}

  [[nodiscard]] float operator()(const Vec3& a, const Vec3& b) const {
    constexpr float kKnee = 0.4F;     // this share of the largest difference…
    constexpr float kAtKnee = 0.95F;  // …becomes this much of the range
    const float difference = std::pow(hyab(a, b), kExponent);
    const float knee = kKnee * largest_;
    if (difference < knee) return kAtKnee / knee * difference;
    return kAtKnee + (difference - knee) / (largest_ - knee) * (1.0F - kAtKnee);
  }

 private:
  static constexpr float kExponent = 0.7F;
  float largest_;
};

}  // namespace

Plane flip(const ColourImage& reference, const ColourImage& test, float pixels_per_degree) {
  const Seen a = look_at_picture(reference, pixels_per_degree);
  const Seen b = look_at_picture(test, pixels_per_degree);
  const ColourDifference colour_difference;
  Plane result(a.edges.size());
  parallel_for(result.size(), 4096, [&](std::size_t i) {
    const float colour = colour_difference(a.colours[i], b.colours[i]);
    const float feature = std::max(std::fabs(a.edges[i] - b.edges[i]), std::fabs(a.points[i] - b.points[i]));
    const float raised = std::sqrt(std::min(feature / std::sqrt(2.0F), 1.0F));
    result[i] = std::min(std::pow(colour, 1.0F - raised), 1.0F);
  });
  return result;
}

}  // namespace grove
