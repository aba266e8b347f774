#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "console.h"
#include "grove/render/denoise/denoise.h"
#include "grove/render/denoise/temporal.h"

namespace grove::app {

/// What is done against noise.
struct DenoiseOptions {
  std::string text = "off";
  Denoise way = Denoise::off;  ///< after `parse_denoise`
};

void add_denoise(CLI::App& verb, DenoiseOptions& options);

/// Has a render gather what the filter needs. Throws UsageError for a way that there is not, and for pictures that are not light.
void parse_denoise(DenoiseOptions& options, RenderSettings& settings);

/// Filters a still picture, where that is asked for; returns the seconds that it took.
double denoise_still(const DenoiseOptions& options, RenderResult& result, const Console& console);

/// Denoises frames that follow each other, and measures motion from one to the next where layers or the filter need it.
class FrameDenoiser {
 public:
  explicit FrameDenoiser(const DenoiseOptions& options) : options_(&options) {}

  /// Before a frame: lets its motion be measured against the frame before, and with `temporal` gives it noise of its own.
  void prepare(RenderSettings& settings, std::uint32_t number) const;

  /// After it, with the settings that it was made with: filters it, where that is asked for. Returns the seconds that it took.
  double finish(RenderResult& frame, const RenderSettings& settings, const Scene& scene);

  /// A frame was left out.
  void skip();

 private:
  const DenoiseOptions* options_;
  TemporalDenoiser denoiser_;
  std::optional<EarlierFrame> earlier_;
};

}  // namespace grove::app
