#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "grove/base/progress.h"
#include "grove/render/film.h"
#include "grove/render/scene_accelerator.h"
#include "grove/scene/scene.h"

namespace grove {

/// What a pixel shows.
enum class Integrator : std::uint8_t {
  path,    ///< global illumination by path tracing
  ao,      ///< the open part of the cosine-weighted hemisphere within `ao_distance`
  normal,  ///< shading normal n as the colour (n + 1) / 2; black where nothing is hit
  depth,   ///< distance from the camera to the first surface along the ray, in world units; 0 where nothing is hit
  cost     ///< work of the camera ray: red nodes visited, green primitives tested, blue their sum
};

/// The names of the integrators, in the order of the enumeration.
[[nodiscard]] std::span<const std::string_view> integrator_names();
/// Throws UsageError that lists the names.
[[nodiscard]] Integrator integrator_from_name(std::string_view name);

struct RenderSettings {
  /// Pixels. Both 0: what the scene's film asks for, else 1280 x 720. One 0: from the other, at the aspect of that size.
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t samples_per_pixel = 64;
  /// The most surfaces that light may scatter at on its way to the camera: 0 shows emission alone, 1 direct light. Surfaces that only let
  /// light through (alpha, interfaces) do not count.
  std::uint32_t max_depth = 8;
  std::uint64_t seed = 0;
  Integrator integrator = Integrator::path;
  /// A camera's name; empty takes the scene's first or, when it has none, a view of the whole scene.
  std::string camera;
  /// World units; 0 takes a tenth of the diagonal of the scene's bounds.
  float ao_distance = 0.0F;
  /// Upper limit on one sample's indirect radiance (in any channel), against fireflies; biases the image. 0 is off.
  float indirect_clamp = 0.0F;
};

struct RenderResult {
  Film film;
  Integrator integrator = Integrator::path;
  /// Empty for the view that was made for a scene without cameras.
  std::string camera;
  std::uint64_t rays_traced = 0;
  /// Samples that came out NaN, infinite or negative and were left out.
  std::uint64_t dropped_samples = 0;
  double seconds = 0.0;
  /// Of all pixels; below 1 only when interrupted. Unfinished pixels are black and hold no samples.
  double completed_fraction = 0.0;
  bool interrupted = false;
  /// One line each, such as that a scene without light was given a sky.
  std::vector<std::string> warnings;
};

/// Makes a picture of `scene`, which `accelerator` must have been built from. Runs in the caller's oneTBB arena over tiles of pixels,
/// and reports pixels done. When the stop token asks, finishes the pixels under way and returns what there is.
///
/// The same scene and settings give the same film, bit for bit, for any number of threads and any structure (`cost` excepted, which
/// shows the structure). Throws UsageError for an unknown camera or impossible settings.
[[nodiscard]] RenderResult render(const Scene& scene, const SceneAccelerator& accelerator, const RenderSettings& settings,
                                  const ProgressReporter& progress = {});

}  // namespace grove
