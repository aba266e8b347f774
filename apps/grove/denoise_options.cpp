#include "denoise_options.h"

#include <fmt/format.h>

#include <CLI/Option.hpp>

#include "grove/base/error.h"
#include "grove/base/timer.h"
#include "grove/lab/text_table.h"
#include "grove/render/view.h"

namespace grove::app {

void add_denoise(CLI::App& verb, DenoiseOptions& options) {
  verb.add_option("--denoise", options.text,
                  "Filter noise out of a path-traced .exr or .png: off, spatial, or temporal (with earlier frames)")
      ->type_name("WAY")
      ->capture_default_str();
}

void parse_denoise(DenoiseOptions& options, RenderSettings& settings) {
  try {
    options.way = denoise_from_name(options.text);
  } catch (const UsageError& error) {
    throw UsageError("--denoise: " + std::string(error.what()));
  }
  if (options.way == Denoise::off) return;
  if (settings.integrator != Integrator::path)
    throw UsageError("--denoise: only path-traced pictures have noise to filter; use --integrator path");
  settings.gathering.first_hits = true;
}

double denoise_still(const DenoiseOptions& options, RenderResult& result, const Console& console) {
  if (options.way == Denoise::off) return 0.0;
  const Timer timer;
  console.status("filtering");
  result.denoised = denoise(result);
  const double seconds = timer.seconds();
  console.say(fmt::format("denoised   in {}", duration(seconds)));
  return seconds;
}

void FrameDenoiser::prepare(RenderSettings& settings, std::uint32_t number) const {
  // Samples of frames that are to be averaged must differ; else the frames share their noise, as they do without.
  if (options_->way == Denoise::temporal) settings.seed += number;
  settings.gathering.earlier = earlier_ ? &*earlier_ : nullptr;
}

double FrameDenoiser::finish(RenderResult& frame, const RenderSettings& settings, const Scene& scene) {
  if (!frame.first_hits) return 0.0;
  const Timer timer;
  const CameraRays camera(choose_view(scene, settings).camera, frame.film.width(), frame.film.height());
  if (options_->way == Denoise::spatial) frame.denoised = denoise(frame);
  if (options_->way == Denoise::temporal) {
    frame.denoised = denoiser_.add(frame, earlier_ ? movement_since(*earlier_, scene, camera) : Movement::some);
  }
  earlier_.emplace(EarlierFrame{ScenePose(scene), camera});
  return timer.seconds();
}

void FrameDenoiser::skip() {
  earlier_.reset();
  denoiser_.restart();
}

}  // namespace grove::app
