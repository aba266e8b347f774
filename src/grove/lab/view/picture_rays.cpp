#include "grove/lab/view/picture_rays.h"

#include <cmath>

#include "grove/render/camera_rays.h"
#include "grove/render/surface/surface_table.h"

namespace grove {
namespace {

Camera pinhole(Camera camera) {
  camera.lens_radius = 0.0F;
  return camera;
}

}  // namespace

PictureRays::PictureRays(const Camera& camera) : camera_(pinhole(camera)) {
  const CameraRays camera_rays(camera_, kWidth, kHeight);
  rays_.reserve(std::size_t{kWidth} * kHeight);
  for (std::uint32_t row = 0; row < kHeight; ++row) {
    for (std::uint32_t column = 0; column < kWidth; ++column)
      rays_.push_back(camera_rays.ray({static_cast<float>(column) + 0.5F, static_cast<float>(row) + 0.5F}, {0.5F, 0.5F}));
  }
}

std::vector<std::uint32_t> PictureRays::pixels(std::uint32_t stride) {
  // The same offset for all strides makes one grid part of another.
  constexpr std::uint32_t kOffset = kLeastStride / 2;
  const std::uint32_t offset = stride < kLeastStride ? 0 : kOffset;
  std::vector<std::uint32_t> pixels;
  pixels.reserve(std::size_t{columns(stride)} * rows(stride));
  for (std::uint32_t row = 0; row < rows(stride); ++row) {
    for (std::uint32_t column = 0; column < columns(stride); ++column)
      pixels.push_back((row * stride + offset) * kWidth + column * stride + offset);
  }
  return pixels;
}

std::vector<std::uint8_t> shade_picture(const Scene& scene, const std::vector<Ray>& rays, const std::vector<Hit>& hits) {
  constexpr float kDarkest = 40.0F;
  const SurfaceTable surfaces(scene);
  std::vector<std::uint8_t> shades(rays.size(), 0);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i]) continue;
    const Vec3 normal = surfaces.at(rays[i], hits[i]).geometric_normal;
    const float cosine = std::abs(glm::dot(normal, rays[i].direction));
    // A triangle too thin to have a normal is dark.
    shades[i] = static_cast<std::uint8_t>(kDarkest + (255.0F - kDarkest) * (cosine <= 1.0F ? cosine : 0.0F));
  }
  return shades;
}

}  // namespace grove
