#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "grove/geometry/hit.h"
#include "grove/render/camera_rays.h"
#include "grove/render/film.h"
#include "grove/render/layers/scene_pose.h"
#include "grove/render/prepared_scene.h"

namespace grove {

/// The frame before, as far as motion is measured against it.
struct EarlierFrame {
  ScenePose pose;
  CameraRays camera;
};

/// What the camera samples of a pixel met first. Depth and motion are means over the samples that met something.
struct FirstHit {
  /// Along the viewing axis, in world units.
  float depth = kNothing;
  /// Where the surface was along the viewing axis of the frame before; as `depth` where there was none.
  float earlier_depth = kNothing;
  /// From the place in the picture before to that now, in pixels, x to the right and y down; zeros where there was no frame before.
  Vec2 motion{0.0F};
  /// Mean over all samples of the light that comes straight from what they met: what it emits, or the sky. There is no noise in it but that of coverage.
  Vec3 emitted{0.0F};
  // The pixel's first sample; kInvalidId where it met nothing.
  std::uint32_t primitive = kInvalidId;
  std::uint32_t geometry = kInvalidId;
  std::uint32_t instance = kInvalidId;

  /// The depth where no sample met anything: what compositors are used to.
  static constexpr float kNothing = 1e10F;
};

/// One for each pixel, row 0 at the top. Memory: 40 bytes a pixel.
class FirstHits {
 public:
  FirstHits() = default;
  FirstHits(std::uint32_t width, std::uint32_t height) : width_(width), pixels_(std::size_t{width} * height) {}

  [[nodiscard]] FirstHit& at(std::uint32_t x, std::uint32_t y) { return pixels_[std::size_t{y} * width_ + x]; }
  [[nodiscard]] const FirstHit& at(std::uint32_t x, std::uint32_t y) const { return pixels_[std::size_t{y} * width_ + x]; }

 private:
  std::uint32_t width_ = 0;
  std::vector<FirstHit> pixels_;
};

/// Which samples a picture was made of.
struct SampleRange {
  std::uint64_t seed = 0;
  std::uint32_t first = 0;  ///< the film's samples are counted from this one
};

/// Traces the camera rays of the samples of each pixel of `film` once more, down to the surface that their paths met first: 32 at most where none of these meets a light or the
/// sky, else all, so that what is emitted can be taken out of the film exactly. As this is a function
/// of scene, camera and samples alone, a render that went on from a checkpoint has the same layers as one that did not stop. Pixels without samples
/// stay as they are made. `earlier` may be null. In parallel in the caller's arena; the result does not depend on the threads.
[[nodiscard]] FirstHits gather_first_hits(const PreparedScene& world, const CameraRays& camera, const Film& film,
                                          const SampleRange& samples, const EarlierFrame* earlier);

}  // namespace grove
