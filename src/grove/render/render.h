#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "grove/base/progress.h"
#include "grove/render/adaptive/noise.h"
#include "grove/render/film.h"
#include "grove/render/image/colour_image.h"
#include "grove/render/layers/first_hits.h"
#include "grove/render/light/light_sampling.h"
#include "grove/render/picture_part.h"
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

/// How many rays the structure is asked about in one call. The picture is the same, bit for bit.
enum class RayCalls : std::uint8_t {
  batches,  ///< those of some thousand paths together, for `path`; the other integrators ask singly
  single    ///< one after another: the reference for batches, and what follows a path through a debugger
};

/// The names of the integrators, in the order of the enumeration.
[[nodiscard]] std::span<const std::string_view> integrator_names();
/// Throws UsageError that lists the names.
[[nodiscard]] Integrator integrator_from_name(std::string_view name);

/// What is gathered beside the film, for layers of the picture and for denoisers. What is not asked for costs nothing.
struct GatheringSettings {
  bool first_hits = false;
  /// Only with first hits: what their motion is measured against; null for none. Must outlive the render.
  const EarlierFrame* earlier = nullptr;
};

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
  LightSampling lights = LightSampling::hierarchy;
  /// A camera's name; empty takes the scene's first or, when it has none, a view of the whole scene.
  std::string camera;
  /// In place of any camera of the scene.
  std::optional<Camera> viewpoint;
  /// World units; 0 takes a tenth of the diagonal of the scene's bounds.
  float ao_distance = 0.0F;
  /// Upper limit on one sample's indirect radiance (in any channel), against fireflies; biases the image. 0 is off.
  float indirect_clamp = 0.0F;
  /// Pixels that are done before they have all samples. Stopping by an estimate biases a picture a little, towards the dark where rare bright samples
  /// have not been met; `noise.min_samples`, pooling with the neighbours, and decisions at the ends of rounds only are against that. Not together
  /// with a part that leaves out samples.
  NoiseTarget noise;
  /// Seconds that `render` may take, the preparing of the scene included; 0 is no limit. A round of samples that would not be finished in time is made
  /// shorter or not begun; one that takes longer than foreseen is cut and taken back, so that the picture is even. The first round, of one sample a
  /// pixel, is always finished.
  double time_limit = 0.0;
  /// What tells the time for that: seconds from any beginning on, called by any thread. Empty takes the machine's clock.
  std::function<double()> clock;
  RayCalls ray_calls = RayCalls::batches;
  /// The part of the picture to make. An end_sample of 0 stands for samples_per_pixel, which it must not exceed.
  PicturePart part;
  GatheringSettings gathering;
};

struct RenderResult {
  Film film;
  std::optional<FirstHits> first_hits;
  /// What a denoiser made of the film; `render` leaves it empty.
  std::optional<ColourImage> denoised;
  Integrator integrator = Integrator::path;
  /// Empty for the view that was made for a scene without cameras.
  std::string camera;
  /// What was asked for: pixels outside of its tiles are black and hold no samples.
  PicturePart part;
  std::uint64_t rays_traced = 0;
  /// Samples that came out NaN, infinite or negative and were left out.
  std::uint64_t dropped_samples = 0;
  /// Rays and seconds are sums over this render and what it went on from.
  double seconds = 0.0;
  /// What `seconds` went into, of which this much was spent before the first ray, on tables of materials and lights.
  double prepare_seconds = 0.0;
  /// And this much after the last ray of the film, on what `GatheringSettings` asks for.
  double gather_seconds = 0.0;
  /// Sums over threads, for rays that are traced in batches; 0 for others: within structures, and on all else that makes samples of hits.
  double trace_seconds = 0.0;
  double shade_seconds = 0.0;
  /// Of all samples of the part, with a noise target of those that it is guessed to need; below 1 only when interrupted or out of time.
  double completed_fraction = 0.0;
  bool interrupted = false;
  /// The time limit was reached before all samples were taken.
  bool out_of_time = false;
  /// One line each, such as that a scene without light was given a sky.
  std::vector<std::string> warnings;

  /// What the picture shows: denoised where it was, else the means of the film.
  [[nodiscard]] ColourImage colours() const { return denoised ? *denoised : mean_colours(film); }
};

/// How a long render goes on from what an earlier one left, and leaves something itself.
struct RenderCheckpoints {
  /// The result of an interrupted render of the same scene and settings, but for samples_per_pixel and part.end_sample, which may have grown.
  std::optional<RenderResult> earlier;
  /// Called at intervals with what there is so far, by the thread that called `render` while no other works on it; may be empty.
  std::function<void(const RenderResult&)> save;
  /// From the end of one call of `save` to the next.
  double interval_seconds = 60.0;
};

/// Makes a picture of `scene`, which `accelerator` must have been built from. Runs in the caller's oneTBB arena over tiles of pixels,
/// in passes that give each pixel a few more samples, and reports samples taken, of those that were left to take. When the stop token asks,
/// finishes the pixels under way (with a noise target, drops the tiles under way) and returns what there is: each pixel with the first so many of its samples.
///
/// The same scene and settings give the same film, bit for bit, for any number of threads, any structure (`cost` excepted, which
/// shows the structure), and however often the render was interrupted and gone on with; a time limit alone makes it depend on the machine. Throws UsageError for an unknown camera or impossible
/// settings, and what `save` throws.
[[nodiscard]] RenderResult render(const Scene& scene, const SceneAccelerator& accelerator, const RenderSettings& settings,
                                  const ProgressReporter& progress = {}, RenderCheckpoints checkpoints = {});

/// The same for a scene that is prepared already, whose way of choosing lights stands for that of the settings.
[[nodiscard]] RenderResult render(const PreparedScene& world, const RenderSettings& settings, const ProgressReporter& progress = {},
                                  RenderCheckpoints checkpoints = {});

}  // namespace grove
