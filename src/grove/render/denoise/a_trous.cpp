#include "grove/render/denoise/a_trous.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "grove/base/parallel.h"

// One exponent serves all edge-stopping functions: max(0, n n')^128 exp(-x) is taken as (max(0, n n') max(0, 1 - x / 128))^128, whose second factor tends to exp(-x) from
// below (at x = 4, where a weight is 0.018, it is 0.017). Seven squarings, no call, and the compiler makes vectors of the loops.

namespace grove {
namespace {

constexpr std::array<float, 3> kSpline = {3.0F / 8.0F, 1.0F / 4.0F, 1.0F / 16.0F};  // of cubic B-splines
constexpr float kInverseExponent = 1.0F / 128.0F;
// Depths along a surface that differ by less than this share are rounding and the averaging of samples.
constexpr float kDepthTolerance = 1e-3F;
// So is luminance.
constexpr float kLuminanceTolerance = 1e-4F;

// Not std::max, which takes references, and no loops: either keeps the loop round it from becoming vectors.
float positive(float x) {
  return x > 0.0F ? x : 0.0F;
}

float power_128(float base) {
  const float to_4 = (base * base) * (base * base);
  const float to_16 = (to_4 * to_4) * (to_4 * to_4);
  const float to_64 = (to_16 * to_16) * (to_16 * to_16);
  return to_64 * to_64;
}

float luminance_of(float red, float green, float blue) {
  return 0.2126F * red + 0.7152F * green + 0.0722F * blue;
}

// One pass over the picture, from `in` to `out`.
class Pass {
 public:
  Pass(const Illumination& in, const Guides& guides, int step, const FilterSettings& settings, Illumination& out)
      : in_(in), guides_(guides), step_(step), settings_(settings), out_(out), luminance_(in.red.size()), per_luminance_(in.red.size()) {
    parallel_for(guides.height, 8, [&](std::size_t y) {
      for (std::size_t i = y * guides.width; i < (y + 1) * guides.width; ++i)
        luminance_[i] = luminance_of(in.red[i], in.green[i], in.blue[i]);
    });
    parallel_for(guides.height, 8, [&](std::size_t y) { prepare_row(y); });
  }

  void run() const {
    const std::size_t blocks = (guides_.width + kBlock - 1) / kBlock;
    parallel_for(guides_.height, 4, [&](std::size_t y) {
      for (std::size_t block = 0; block < blocks; ++block)
        filter_block(y, block * kBlock, std::min<std::size_t>(guides_.width, (block + 1) * kBlock));
    });
  }

 private:
  static constexpr std::size_t kBlock = 128;

  // What to multiply differences of luminance with, from the variance around the pixel: a single one is as noisy as the light.
  void prepare_row(std::size_t y) {
    const std::size_t width = guides_.width;
    const std::size_t above = y > 0 ? y - 1 : y;
    const std::size_t below = y + 1 < guides_.height ? y + 1 : y;
    const auto column = [&](std::size_t x) {
      const auto& v = in_.variance;
      return 0.25F * v[above * width + x] + 0.5F * v[y * width + x] + 0.25F * v[below * width + x];
    };
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t left = x > 0 ? x - 1 : x;
      const std::size_t right = x + 1 < width ? x + 1 : x;
      const float variance = 0.25F * column(left) + 0.5F * column(x) + 0.25F * column(right);
      const std::size_t i = y * width + x;
      const float slack = settings_.luminance_slack * std::sqrt(std::max(variance, 0.0F)) + kLuminanceTolerance * luminance_[i] + 1e-12F;
      per_luminance_[i] = kInverseExponent / slack;
    }
  }

  // Filters the pixels from first_x to end_x of row y, tap by tap, so that neighbours are worked on together. The sums are local arrays: so the compiler knows that
  // nothing else is written.
  void filter_block(std::size_t y, std::size_t first_x, std::size_t end_x) const {
    const auto width = static_cast<std::ptrdiff_t>(guides_.width);
    const std::size_t here = y * guides_.width + first_x;
    std::array<float, kBlock> weights;
    std::array<float, kBlock> reds;
    std::array<float, kBlock> greens;
    std::array<float, kBlock> blues;
    std::array<float, kBlock> variances;
    // A pixel always counts itself.
    constexpr float kCentre = kSpline[0] * kSpline[0];
    for (std::size_t i = 0; i < end_x - first_x; ++i) {
      weights[i] = kCentre;
      reds[i] = kCentre * in_.red[here + i];
      greens[i] = kCentre * in_.green[here + i];
      blues[i] = kCentre * in_.blue[here + i];
      variances[i] = kCentre * kCentre * in_.variance[here + i];
    }
    // p is the pixel, q the other.
    const float* const nxp = guides_.normal_x.data() + here;
    const float* const nyp = guides_.normal_y.data() + here;
    const float* const nzp = guides_.normal_z.data() + here;
    const float* const zp = guides_.depth.data() + here;
    const float* const sx = guides_.slope_x.data() + here;
    const float* const sy = guides_.slope_y.data() + here;
    const float* const lp = luminance_.data() + here;
    const float* const per_l = per_luminance_.data() + here;
    for (int tap = 0; tap < 25; ++tap) {
      const int dx = tap % 5 - 2;
      const int dy = tap / 5 - 2;
      const std::ptrdiff_t other_y = static_cast<std::ptrdiff_t>(y) + std::ptrdiff_t{dy} * step_;
      if ((dx == 0 && dy == 0) || other_y < 0 || other_y >= static_cast<std::ptrdiff_t>(guides_.height)) continue;
      // The pixels of the block whose tap is within the picture.
      const std::ptrdiff_t shift = std::ptrdiff_t{dx} * step_;
      const auto begin = std::max(static_cast<std::ptrdiff_t>(first_x), -shift) - static_cast<std::ptrdiff_t>(first_x);
      const auto end = std::min(static_cast<std::ptrdiff_t>(end_x), width - shift) - static_cast<std::ptrdiff_t>(first_x);
      const float kernel = kSpline[static_cast<std::size_t>(std::abs(dx))] * kSpline[static_cast<std::size_t>(std::abs(dy))];
      const float across = settings_.depth_slack * static_cast<float>(shift);
      const float down = settings_.depth_slack * static_cast<float>(dy * step_);
      const std::ptrdiff_t there = other_y * width + static_cast<std::ptrdiff_t>(first_x) + shift;
      const float* const nxq = guides_.normal_x.data() + there;
      const float* const nyq = guides_.normal_y.data() + there;
      const float* const nzq = guides_.normal_z.data() + there;
      const float* const zq = guides_.depth.data() + there;
      const float* const lq = luminance_.data() + there;
      const float* const red = in_.red.data() + there;
      const float* const green = in_.green.data() + there;
      const float* const blue = in_.blue.data() + there;
      const float* const variance = in_.variance.data() + there;
      for (std::ptrdiff_t x = begin; x < end; ++x) {
        const float cosine = nxp[x] * nxq[x] + nyp[x] * nyq[x] + nzp[x] * nzq[x];
        const float depth_range = std::fabs(sx[x] * across + sy[x] * down) + kDepthTolerance * zp[x];
        const float apart = kInverseExponent * std::fabs(zp[x] - zq[x]) / depth_range + std::fabs(lp[x] - lq[x]) * per_l[x];
        const float weight = kernel * power_128(positive(cosine) * positive(1.0F - apart));
        const auto i = static_cast<std::size_t>(x);
        weights[i] += weight;
        reds[i] += weight * red[x];
        greens[i] += weight * green[x];
        blues[i] += weight * blue[x];
        variances[i] += weight * weight * variance[x];
      }
    }
    for (std::size_t i = 0; i < end_x - first_x; ++i) {
      const float scale = 1.0F / weights[i];
      out_.red[here + i] = scale * reds[i];
      out_.green[here + i] = scale * greens[i];
      out_.blue[here + i] = scale * blues[i];
      out_.variance[here + i] = scale * scale * variances[i];
    }
  }

  const Illumination& in_;
  const Guides& guides_;
  int step_;
  const FilterSettings& settings_;
  Illumination& out_;
  std::vector<float> luminance_;
  std::vector<float> per_luminance_;
};

}  // namespace

Illumination filter_a_trous(Illumination light, const Guides& guides, const FilterSettings& settings) {
  Illumination other(light.red.size());
  for (int pass = 0; pass < settings.passes; ++pass) {
    Pass(light, guides, 1 << pass, settings, other).run();
    std::swap(light, other);
  }
  return light;
}

}  // namespace grove
