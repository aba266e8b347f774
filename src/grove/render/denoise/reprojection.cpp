#include "grove/render/denoise/reprojection.h"

#include <cmath>

namespace grove {
namespace {

bool shows_the_same(const PixelHistory& then, const FirstHit& hit, const Vec3& normal) {
  constexpr float kDepthTolerance = 0.02F;
  constexpr float kLeastCosine = 0.906F;
  return then.sample_count > 0.0F && then.geometry == hit.geometry && then.instance == hit.instance &&
         std::fabs(then.depth - hit.earlier_depth) <= kDepthTolerance * hit.earlier_depth && glm::dot(then.normal, normal) >= kLeastCosine;
}

void add(const PixelHistory& then, float weight, PixelHistory& sum) {
  sum.reflected += weight * then.reflected;
  sum.unclamped += weight * then.unclamped;
  sum.albedo += weight * then.albedo;
  sum.emitted += weight * then.emitted;
  sum.sample_variance += weight * then.sample_variance;
  sum.share += weight * then.share;
  sum.sample_count += weight * then.sample_count;
}

}  // namespace

PixelHistory reprojected(const FrameHistory& history, const FirstHit& hit, const Guides& guides, std::uint32_t x, std::uint32_t y) {
  const std::size_t pixel = std::size_t{y} * guides.width + x;
  const Vec3 normal(guides.normal_x[pixel], guides.normal_y[pixel], guides.normal_z[pixel]);
  // Relative to pixel centres.
  const Vec2 before = Vec2(static_cast<float>(x), static_cast<float>(y)) - hit.motion;
  PixelHistory result;
  // What is far outside might not fit an integer; a NaN fails too.
  if (!(before.x > -1.0F && before.y > -1.0F && before.x < static_cast<float>(history.width) &&
        before.y < static_cast<float>(history.height))) {
    return result;
  }
  const auto at = [&](std::ptrdiff_t column, std::ptrdiff_t row) -> const PixelHistory* {
    if (column < 0 || row < 0 || column >= static_cast<std::ptrdiff_t>(history.width) ||
        row >= static_cast<std::ptrdiff_t>(history.height)) {
      return nullptr;
    }
    const PixelHistory& then = history.pixels[static_cast<std::size_t>(row) * history.width + static_cast<std::size_t>(column)];
    return shows_the_same(then, hit, normal) ? &then : nullptr;
  };
  const Vec2 corner(std::floor(before.x), std::floor(before.y));
  const Vec2 part = before - corner;
  const auto left = static_cast<std::ptrdiff_t>(corner.x);
  const auto top = static_cast<std::ptrdiff_t>(corner.y);
  float weights = 0.0F;
  for (std::ptrdiff_t tap = 0; tap < 4; ++tap) {
    const std::ptrdiff_t right = tap % 2;
    const std::ptrdiff_t down = tap / 2;
    const float weight = (right == 1 ? part.x : 1.0F - part.x) * (down == 1 ? part.y : 1.0F - part.y);
    if (const PixelHistory* then = at(left + right, top + down); then != nullptr && weight > 0.0F) {
      add(*then, weight, result);
      weights += weight;
    }
  }
  constexpr float kLeastWeight = 0.01F;
  if (weights < kLeastWeight) {
    result = {};
    weights = 0.0F;
    const auto centre_x = static_cast<std::ptrdiff_t>(std::lround(before.x));
    const auto centre_y = static_cast<std::ptrdiff_t>(std::lround(before.y));
    float nearest = 4.0F;
    for (std::ptrdiff_t row = centre_y - 1; row <= centre_y + 1; ++row) {
      for (std::ptrdiff_t column = centre_x - 1; column <= centre_x + 1; ++column) {
        const Vec2 apart = Vec2(static_cast<float>(column), static_cast<float>(row)) - before;
        const PixelHistory* then = at(column, row);
        if (then == nullptr || !(glm::dot(apart, apart) < nearest)) continue;
        nearest = glm::dot(apart, apart);
        result = {};
        add(*then, 1.0F, result);
        weights = 1.0F;
      }
    }
    if (weights == 0.0F) return result;
  }
  const float scale = 1.0F / weights;
  result.reflected *= scale;
  result.unclamped *= scale;
  result.albedo *= scale;
  result.emitted *= scale;
  result.sample_variance *= scale;
  result.share *= scale;
  result.sample_count *= scale;
  return result;
}

}  // namespace grove
