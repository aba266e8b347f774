#include "denoise_options.h"

#include <fmt/format.h>

#include <CLI/Option.hpp>

#include "grove/base/error.h"
#include "grove/base/timer.h"
#include "grove/lab/text_table.h"

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
  settings.gathering.moments = true;
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

}  // namespace grove::app
