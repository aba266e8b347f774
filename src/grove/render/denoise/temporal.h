#pragma once

#include "grove/render/denoise/denoise.h"
#include "grove/render/denoise/history.h"

namespace grove {

/// What may have changed from one frame to the next.
enum class Movement : std::uint8_t {
  none,  ///< neither camera, lights nor geometry: the frames are further samples of one picture
  some
};

/// What has moved since `earlier`. Compares all vertices.
[[nodiscard]] Movement movement_since(const EarlierFrame& earlier, const Scene& scene, const CameraRays& camera);

struct TemporalSettings {
  /// The most samples that the history counts for where something moves, as a multiple of those of the frame: the more, the smoother, and the longer the light of a
  /// moved lamp lingers.
  float longest_history = 24.0F;
  /// How far history may be from what the frame shows within 7 x 7 pixels, in standard deviations of that.
  float clamp = 1.0F;
  FilterSettings filter;
};

/// Frames one after the other with less noise than each has for itself: samples of earlier frames are carried along with the surface that they were taken on, and what noise is
/// left is filtered. After SVGF (see a_trous.h) with these differences: means count samples and not frames; the variance of the accumulated light follows from those of its parts instead
/// of from moments; history is clamped to what the frame shows nearby (after Salvi 2016, "An Excursion in Temporal Supersampling"), which takes ghosts of moved shadows away; and
/// what the filter made is not fed back into the history, so that its bias does not pile up. Fireflies are limited and noise is estimated in what has been accumulated, not in each frame, and
/// the brightness that clamping takes is given back (brightness.h).
///
/// As long as nothing moves, history is neither resampled, clamped nor limited: the unfiltered part is then the mean over the samples of all frames, exactly up to rounding, the
/// variance falls as 1 / frames, and with it the strength of the filter, so that the pictures tend to the unfiltered one. Frames must have different seeds.
///
/// Not for several threads at once; works in parallel in the caller's arena, with the same result for any number of threads. Memory: 84 bytes a pixel between frames.
class TemporalDenoiser {
 public:
  explicit TemporalDenoiser(const TemporalSettings& settings = {}) : settings_(settings) {}

  /// Takes in the next frame and returns it denoised. `frame` must hold first hits, and where something moved its motion must have been measured against the frame before
  /// (`GatheringSettings::earlier`). A frame of another size starts anew. O(pixels).
  [[nodiscard]] ColourImage add(const RenderResult& frame, Movement movement);

  /// Forgets all frames, as after a cut.
  void restart() { history_ = {}; }

  /// After the last frame; empty before the first.
  [[nodiscard]] const FrameHistory& history() const { return history_; }

 private:
  TemporalSettings settings_;
  FrameHistory history_;
};

}  // namespace grove
