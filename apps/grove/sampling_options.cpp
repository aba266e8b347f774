#include "sampling_options.h"

#include <cstdint>

#include "grove/base/error.h"
#include "options.h"

namespace grove::app {
namespace {

constexpr std::uint32_t kMostForNoise = 4096;
constexpr std::uint32_t kMostInTime = 1 << 20;

}  // namespace

void add_sampling(CLI::App& verb, SamplingOptions& options) {
  verb.add_option("--lights", options.lights, "How one of many lights is chosen: hierarchy, groups, power or uniform")
      ->type_name("NAME")
      ->capture_default_str();
  CLI::Option* const noise = verb.add_option("--noise", options.noise,
                                             "Stop sampling a pixel when its noise, as a share of its brightness, is at most this; --spp "
                                             "(4096 when not given) is the most")
                                 ->type_name("TARGET");
  in_range(noise, 1e-4, 1.0);
  in_range(verb.add_option("--min-spp", options.min_samples, "With --noise: samples that each pixel gets (default 16)")
               ->type_name("N")
               ->needs(noise),
           std::uint64_t{2}, std::uint64_t{1} << 20);
  in_range(verb.add_option("--noise-floor", options.noise_floor,
                           "With --noise: the luminance below which pixels count as this bright (default 0.01)")
               ->type_name("L")
               ->needs(noise),
           1e-9, 1e9);
  in_range(verb.add_option("--time-limit", options.time_limit,
                           "Render what can be done in this many seconds, at most --spp samples (no limit when not given)")
               ->type_name("SECONDS"),
           0.001, 1e7);
}

void apply_sampling(const SamplingOptions& options, bool has_samples, bool has_range, RenderSettings& settings) {
  settings.lights = light_sampling_from_name(options.lights);
  settings.time_limit = options.time_limit.value_or(0.0);
  if (options.noise) {
    if (has_range)
      throw UsageError("--noise: does not go with --samples, since samples that are left out cannot be judged; share work by --tile");
    settings.noise.target = static_cast<float>(*options.noise);
    if (options.min_samples) settings.noise.min_samples = static_cast<std::uint32_t>(*options.min_samples);
    if (options.noise_floor) settings.noise.floor = static_cast<float>(*options.noise_floor);
  }
  if (has_samples) return;
  if (options.noise) settings.samples_per_pixel = kMostForNoise;
  if (options.time_limit) settings.samples_per_pixel = kMostInTime;
}

}  // namespace grove::app
