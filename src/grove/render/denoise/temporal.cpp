#include "grove/render/denoise/temporal.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "grove/base/parallel.h"
#include "grove/render/bsdf/bsdf_types.h"
#include "grove/render/denoise/reprojection.h"

namespace grove {
namespace {

struct Range {
  Vec3 low;
  Vec3 high;

  [[nodiscard]] Vec3 clamp(const Vec3& value) const { return glm::min(glm::max(value, low), high); }
};

// What light a frame shows around a pixel, on surfaces that face the same way: mean and `deviations` standard deviations either way.
Range light_nearby(const TakenApart& frame, std::uint32_t x, std::uint32_t y, float deviations) {
  constexpr std::uint32_t kRadius = 3;
  constexpr float kLeastCosine = 0.9F;
  const Guides& guides = frame.guides;
  const std::size_t p = std::size_t{y} * guides.width + x;
  const Vec3 centre = frame.light.colour(p);
  Vec3 sum(0.0F);
  Vec3 squares(0.0F);
  float count = 0.0F;
  for (std::uint32_t qy = y - std::min(y, kRadius); qy < std::min(guides.height, y + kRadius + 1); ++qy) {
    for (std::uint32_t qx = x - std::min(x, kRadius); qx < std::min(guides.width, x + kRadius + 1); ++qx) {
      const std::size_t q = std::size_t{qy} * guides.width + qx;
      const float cosine =
          guides.normal_x[p] * guides.normal_x[q] + guides.normal_y[p] * guides.normal_y[q] + guides.normal_z[p] * guides.normal_z[q];
      if (q != p && !(cosine >= kLeastCosine)) continue;
      // From the pixel's own value, so that no digits are lost.
      const Vec3 difference = frame.light.colour(q) - centre;
      sum += difference;
      squares += difference * difference;
      count += 1.0F;
    }
  }
  const Vec3 mean = sum / count;
  const Vec3 slack = deviations * glm::sqrt(glm::max(squares / count - mean * mean, Vec3(0.0F)));
  return {centre + mean - slack, centre + mean + slack};
}

// The albedos of a frame around a pixel.
Range albedo_nearby(const Guides& guides, std::uint32_t x, std::uint32_t y) {
  Range range{Vec3(std::numeric_limits<float>::max()), Vec3(0.0F)};
  for (std::uint32_t qy = y - std::min(y, 1U); qy < std::min(guides.height, y + 2); ++qy) {
    for (std::uint32_t qx = x - std::min(x, 1U); qx < std::min(guides.width, x + 2); ++qx) {
      const Vec3& albedo = guides.albedo[std::size_t{qy} * guides.width + qx];
      range.low = glm::min(range.low, albedo);
      range.high = glm::max(range.high, albedo);
    }
  }
  return range;
}

float luminance_of(const PixelHistory& pixel) {
  return luminance(pixel.reflected / divisor(pixel.albedo));
}

// The variance of one sample, from two sets of samples with what is known of each, and the distance of their means (Chan, Golub and LeVeque 1983, "Algorithms for Computing the Sample Variance").
float pooled_variance(const PixelHistory& older, const PixelHistory& newer) {
  const float all = older.sample_count + newer.sample_count;
  if (!(all >= 2.0F)) return 0.0F;
  const float apart = luminance_of(newer) - luminance_of(older);
  const float deviations = std::max(older.sample_count - 1.0F, 0.0F) * older.sample_variance +
                           std::max(newer.sample_count - 1.0F, 0.0F) * newer.sample_variance +
                           older.sample_count * newer.sample_count / all * apart * apart;
  return deviations / (all - 1.0F);
}

// Takes `weight` of the newer and the rest of the older. What both found out is independent, so that variances of means add with squared weights.
PixelHistory blended(const PixelHistory& older, const PixelHistory& newer, float weight) {
  const float rest = 1.0F - weight;
  PixelHistory result = newer;
  result.reflected = rest * older.reflected + weight * newer.reflected;
  result.unclamped = rest * older.unclamped + weight * newer.unclamped;
  result.albedo = rest * older.albedo + weight * newer.albedo;
  result.emitted = rest * older.emitted + weight * newer.emitted;
  result.sample_variance = pooled_variance(older, newer);
  result.share = rest * rest * older.share + weight * weight * newer.share;
  result.sample_count = older.sample_count + newer.sample_count;
  return result;
}

PixelHistory pixel_of(const TakenApart& frame, const FirstHit& hit, std::size_t i, float sample_count) {
  PixelHistory pixel;
  pixel.albedo = frame.guides.albedo[i];
  pixel.reflected = frame.light.colour(i) * divisor(pixel.albedo);
  pixel.unclamped = pixel.reflected;
  pixel.emitted = frame.emitted[i];
  pixel.sample_count = sample_count;
  pixel.share = sample_count > 0.0F ? 1.0F / sample_count : 0.0F;
  // What was measured is the variance of the mean.
  pixel.sample_variance = sample_count * frame.noise[i].variance;
  pixel.normal = {frame.guides.normal_x[i], frame.guides.normal_y[i], frame.guides.normal_z[i]};
  pixel.depth = hit.depth;
  pixel.geometry = hit.geometry;
  pixel.instance = hit.instance;
  return pixel;
}

// History found again after a movement, made to fit what the frame shows.
PixelHistory mended(PixelHistory older, const PixelHistory& newer, const TakenApart& frame, std::uint32_t x, std::uint32_t y,
                    const TemporalSettings& settings) {
  const Vec3 light = light_nearby(frame, x, y, settings.clamp).clamp(older.reflected / divisor(older.albedo));
  older.albedo = albedo_nearby(frame.guides, x, y).clamp(older.albedo);
  older.reflected = light * divisor(older.albedo);
  // Lights and skies have no noise to wait for.
  older.emitted = newer.emitted;
  older.sample_count = std::min(older.sample_count, settings.longest_history * newer.sample_count);
  return older;
}

}  // namespace

Movement movement_since(const EarlierFrame& earlier, const Scene& scene, const CameraRays& camera) {
  return earlier.camera == camera && earlier.pose.is_pose_of(scene) ? Movement::none : Movement::some;
}

ColourImage TemporalDenoiser::add(const RenderResult& frame, Movement movement) {
  const Film& film = frame.film;
  TakenApart parts = take_apart(frame);
  const bool has_history = history_.width == film.width() && history_.height == film.height();
  FrameHistory next{film.width(), film.height(), std::vector<PixelHistory>(std::size_t{film.width()} * film.height())};
  parallel_for(film.height(), 4, [&](std::size_t row) {
    const auto y = static_cast<std::uint32_t>(row);
    for (std::uint32_t x = 0; x < film.width(); ++x) {
      const std::size_t i = row * film.width() + x;
      const FirstHit& hit = frame.first_hits->at(x, y);
      const PixelHistory newer = pixel_of(parts, hit, i, static_cast<float>(film.pixel(x, y).sample_count));
      PixelHistory older;
      if (has_history && movement == Movement::none) {
        older = history_.pixels[i];
      } else if (has_history && parts.guides.is_surface(i)) {
        older = reprojected(history_, hit, parts.guides, x, y);
        if (older.sample_count > 0.0F) older = mended(older, newer, parts, x, y, settings_);
      }
      const float all = older.sample_count + newer.sample_count;
      next.pixels[i] = older.sample_count > 0.0F && all > 0.0F ? blended(older, newer, newer.sample_count / all) : newer;
    }
  });
  history_ = std::move(next);

  const std::vector<PixelHistory>& pixels = history_.pixels;
  BrightnessEvidence evidence{Illumination(pixels.size()), Illumination(movement == Movement::some ? pixels.size() : 0)};
  parallel_for(pixels.size(), 4096, [&](std::size_t i) {
    const PixelHistory& pixel = pixels[i];
    const Vec3 by = divisor(pixel.albedo);
    evidence.samples.set_colour(i, pixel.unclamped / by);
    if (movement == Movement::some) {
      evidence.newest.set_colour(i, parts.light.colour(i));
      const auto x = static_cast<std::uint32_t>(i % film.width());
      const auto y = static_cast<std::uint32_t>(i / film.width());
      evidence.newest.variance[i] = pixel.sample_variance / static_cast<float>(std::max(1U, film.pixel(x, y).sample_count));
    }
    parts.light.set_colour(i, pixel.reflected / by);
    parts.noise[i].variance = pixel.share * pixel.sample_variance;
    parts.noise[i].is_known = pixel.sample_count >= 2.0F;
  });
  const Illumination light =
      filter_light(std::move(parts.light), std::move(parts.noise), parts.guides, settings_.filter, std::move(evidence));
  ColourImage image(film.width(), film.height());
  parallel_for(pixels.size(), 4096, [&](std::size_t i) {
    const PixelHistory& pixel = pixels[i];
    const Vec3 reflected = parts.guides.is_surface(i) ? light.colour(i) * divisor(pixel.albedo) : pixel.reflected;
    image.pixels[i] = reflected + pixel.emitted;
  });
  return image;
}

}  // namespace grove
