#include "grove/render/light/environment_light.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "grove/render/bsdf/bsdf_types.h"
#include "grove/render/light/environment_mapping.h"
#include "grove/render/sampling/warp.h"

namespace grove {
namespace {

// The table of the density need not be finer than this to follow a sun of half a degree.
constexpr std::uint32_t kMaxTableSide = 2048;

bool has_pixels(const Image& image) {
  return image.width > 0 && image.height > 0 && !(image.bytes.empty() && image.floats.empty());
}

float decode_srgb(std::uint8_t byte) {
  const float encoded = static_cast<float>(byte) / 255.0F;
  return encoded <= 0.04045F ? encoded / 12.92F : std::pow((encoded + 0.055F) / 1.055F, 2.4F);
}

}  // namespace

EnvironmentLight::EnvironmentLight(const Environment& environment, std::shared_ptr<const Image> image)
    : environment_(environment), environment_to_world_(glm::inverse(environment.world_to_environment)), image_(std::move(image)) {
  if (image_ != nullptr && !has_pixels(*image_)) image_ = nullptr;
  if (image_ == nullptr) {
    mean_luminance_ = luminance(environment_.radiance);
    return;
  }
  // Each cell weighs what its corners and middle show, since the bilinear picture is not constant in it, times its solid angle.
  const std::uint32_t width = std::min(image_->width, kMaxTableSide);
  const std::uint32_t height = std::min(image_->height, kMaxTableSide);
  std::vector<float> weights(std::size_t{width} * height);
  std::vector<float> solid_angles(height, 1.0F);
  double sum = 0.0;
  double area = 0.0;
  for (std::uint32_t y = 0; y < height; ++y) {
    // On the octahedral picture all cells are equal.
    const float polar = kPi * (static_cast<float>(y) + 0.5F) / static_cast<float>(height);
    const float solid_angle = environment_.mapping == EnvironmentMapping::equirectangular ? std::sin(polar) : 1.0F;
    for (std::uint32_t x = 0; x < width; ++x) {
      float light = 0.0F;
      for (int corner = 0; corner < 9; ++corner) {
        const int row = corner / 3;
        const int column = corner % 3;
        const Vec2 place(static_cast<float>(x) + 0.5F * static_cast<float>(column), static_cast<float>(y) + 0.5F * static_cast<float>(row));
        light += luminance(lookup({place.x / static_cast<float>(width), place.y / static_cast<float>(height)}));
      }
      if (!std::isfinite(light)) light = 0.0F;
      weights[std::size_t{y} * width + x] = light / 9.0F * solid_angle;
      sum += static_cast<double>(light / 9.0F * solid_angle);
      area += static_cast<double>(solid_angle);
    }
  }
  mean_luminance_ = static_cast<float>(sum / area);
  distribution_ = Distribution2D(weights, width, height);
}

Vec3 EnvironmentLight::pixel(std::int64_t x, std::int64_t y) const {
  const std::int64_t width = image_->width;
  const std::int64_t height = image_->height;
  if (environment_.mapping == EnvironmentMapping::equirectangular) {
    x = (x % width + width) % width;
    y = std::clamp<std::int64_t>(y, 0, height - 1);
  } else {
    // Across an edge of the octahedral square lies the mirrored part of the same edge.
    if (x < 0 || x >= width) {
      x = x < 0 ? 0 : width - 1;
      y = height - 1 - y;
    }
    if (y < 0 || y >= height) {
      y = y < 0 ? 0 : height - 1;
      x = width - 1 - x;
    }
  }
  const std::size_t first = (static_cast<std::size_t>(y) * image_->width + static_cast<std::size_t>(x)) * image_->channels;
  const std::uint32_t step = image_->channels >= 3 ? 1 : 0;
  Vec3 value;
  for (std::uint32_t c = 0; c < 3; ++c) {
    const float raw = image_->is_float() ? image_->floats[first + c * step] : decode_srgb(image_->bytes[first + c * step]);
    value[static_cast<int>(c)] = raw > 0.0F ? raw : 0.0F;
  }
  return value;
}

Vec3 EnvironmentLight::lookup(const Vec2& uv) const {
  const float x = uv.x * static_cast<float>(image_->width) - 0.5F;
  const float y = uv.y * static_cast<float>(image_->height) - 0.5F;
  const float left = std::floor(x);
  const float top = std::floor(y);
  const auto x0 = static_cast<std::int64_t>(left);
  const auto y0 = static_cast<std::int64_t>(top);
  const float fx = x - left;
  const float fy = y - top;
  return environment_.radiance * ((pixel(x0, y0) * (1.0F - fx) + pixel(x0 + 1, y0) * fx) * (1.0F - fy) +
                                  (pixel(x0, y0 + 1) * (1.0F - fx) + pixel(x0 + 1, y0 + 1) * fx) * fy);
}

Vec3 EnvironmentLight::radiance(const Vec3& direction) const {
  if (image_ == nullptr) return environment_.radiance;
  return lookup(environment_uv(environment_.mapping, glm::normalize(environment_.world_to_environment * direction)));
}

EnvironmentLight::Sample EnvironmentLight::sample(const Vec2& u) const {
  if (image_ == nullptr) return {sample_sphere(u), environment_.radiance, 1.0F / (4.0F * kPi)};
  const Distribution2D::Draw draw = distribution_.draw(u);
  const Vec3 local = environment_direction(environment_.mapping, draw.point);
  const float pdf = draw.density * environment_area_per_solid_angle(environment_.mapping, local);
  if (!(pdf > 0.0F) || !std::isfinite(pdf)) return {};
  return {glm::normalize(environment_to_world_ * local), lookup(draw.point), pdf};
}

float EnvironmentLight::pdf(const Vec3& direction) const {
  if (image_ == nullptr) return 1.0F / (4.0F * kPi);
  const Vec3 local = glm::normalize(environment_.world_to_environment * direction);
  const float pdf =
      distribution_.density(environment_uv(environment_.mapping, local)) * environment_area_per_solid_angle(environment_.mapping, local);
  return std::isfinite(pdf) ? pdf : 0.0F;
}

EnvironmentLight make_default_sky() {
  constexpr std::uint32_t kWidth = 64;
  constexpr std::uint32_t kHeight = 32;
  auto image = std::make_shared<Image>();
  image->name = "default sky";
  image->width = kWidth;
  image->height = kHeight;
  image->channels = 3;
  image->floats.resize(std::size_t{kWidth} * kHeight * 3);
  // A broad glow from above and to the left of a viewer who looks along -z gives shapes a lit and a shaded side.
  const Vec3 glow = glm::normalize(Vec3(-0.5F, 0.7F, 0.5F));
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const Vec2 uv((static_cast<float>(x) + 0.5F) / kWidth, (static_cast<float>(y) + 0.5F) / kHeight);
      const Vec3 w = environment_direction(EnvironmentMapping::equirectangular, uv);
      const float height = 0.5F + 0.5F * std::tanh(4.0F * w.y);  // a soft horizon
      const Vec3 sky = Vec3(0.75F, 0.85F, 1.0F) * (0.7F + 0.3F * (1.0F - std::max(0.0F, w.y)));
      const Vec3 ground(0.28F, 0.26F, 0.24F);
      const float shine = std::pow(std::max(0.0F, glm::dot(w, glow)), 12.0F);
      const Vec3 value = ground * (1.0F - height) + sky * height + Vec3(3.6F, 3.3F, 2.9F) * shine;
      for (std::uint32_t c = 0; c < 3; ++c) {
        image->floats[(std::size_t{y} * kWidth + x) * 3 + c] = value[static_cast<int>(c)];
      }
    }
  }
  Environment environment;
  environment.radiance = Vec3(1.0F);
  return {environment, image};
}

}  // namespace grove
