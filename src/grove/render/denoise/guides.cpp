#include "grove/render/denoise/guides.h"

#include <cmath>

#include "grove/base/parallel.h"

namespace grove {
namespace {

// The smaller of the steps to either neighbour: the larger leads off the surface where the two differ much.
float slope(float before, float here, float after) {
  const float back = here - before;
  const float ahead = after - here;
  return std::fabs(back) < std::fabs(ahead) ? back : ahead;
}

}  // namespace

Guides Guides::of(const Film& film, const FirstHits& hits) {
  Guides guides;
  const std::uint32_t width = film.width();
  const std::uint32_t height = film.height();
  const std::size_t count = std::size_t{width} * height;
  guides.width = width;
  guides.height = height;
  for (auto* plane : {&guides.normal_x, &guides.normal_y, &guides.normal_z, &guides.depth, &guides.slope_x, &guides.slope_y}) {
    plane->resize(count);
  }
  guides.albedo.resize(count);
  parallel_for(height, 4, [&](std::size_t row) {
    const auto y = static_cast<std::uint32_t>(row);
    for (std::uint32_t x = 0; x < width; ++x) {
      const std::size_t i = row * width + x;
      const Film::Sample mean = film.mean(x, y);
      const float length = glm::length(mean.normal);
      const Vec3 normal = length > 1e-6F ? mean.normal / length : Vec3(0.0F);
      guides.normal_x[i] = normal.x;
      guides.normal_y[i] = normal.y;
      guides.normal_z[i] = normal.z;
      guides.albedo[i] = mean.albedo;
      guides.depth[i] = hits.at(x, y).depth;
    }
  });
  parallel_for(height, 4, [&](std::size_t row) {
    const auto y = static_cast<std::uint32_t>(row);
    for (std::uint32_t x = 0; x < width; ++x) {
      const std::size_t i = row * width + x;
      const float here = guides.depth[i];
      const float left = x > 0 ? guides.depth[i - 1] : 2.0F * here - guides.depth[x + 1 < width ? i + 1 : i];
      const float right = x + 1 < width ? guides.depth[i + 1] : 2.0F * here - left;
      const float above = y > 0 ? guides.depth[i - width] : 2.0F * here - guides.depth[y + 1 < height ? i + width : i];
      const float below = y + 1 < height ? guides.depth[i + width] : 2.0F * here - above;
      guides.slope_x[i] = slope(left, here, right);
      guides.slope_y[i] = slope(above, here, below);
    }
  });
  return guides;
}

}  // namespace grove
