#pragma once

#include <cstdint>
#include <vector>

#include "grove/geometry/hit.h"
#include "grove/geometry/ray.h"
#include "grove/scene/camera.h"
#include "grove/scene/scene.h"

namespace grove {

/// The rays of a picture, one through the middle of each pixel, row by row from the top. Some of them, every `stride`th of every `stride`th row, are for
/// looking at one by one.
class PictureRays {
 public:
  static constexpr std::uint32_t kWidth = 384;
  static constexpr std::uint32_t kHeight = 216;
  /// The least distance of rays that are looked at.
  static constexpr std::uint32_t kLeastStride = 4;

  /// Throws as CameraRays does.
  explicit PictureRays(const Camera& camera);

  [[nodiscard]] const Camera& camera() const { return camera_; }
  [[nodiscard]] const std::vector<Ray>& rays() const { return rays_; }

  /// The pixels of every `stride`th ray of every `stride`th row. Those of a multiple of a stride are among those of the stride, if both are multiples of
  /// kLeastStride.
  [[nodiscard]] static std::vector<std::uint32_t> pixels(std::uint32_t stride);
  /// How many of them there are in a row, and rows.
  [[nodiscard]] static std::uint32_t columns(std::uint32_t stride) { return kWidth / stride; }
  [[nodiscard]] static std::uint32_t rows(std::uint32_t stride) { return kHeight / stride; }

 private:
  Camera camera_;
  std::vector<Ray> rays_;
};

/// How bright the surface is that each ray meets, as if lit from the eye: 1 to 255, and 0 where a ray meets nothing.
[[nodiscard]] std::vector<std::uint8_t> shade_picture(const Scene& scene, const std::vector<Ray>& rays, const std::vector<Hit>& hits);

}  // namespace grove
