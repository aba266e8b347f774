#include "sampling_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "grove/lab/text_table.h"

namespace grove::app {
namespace {

double rate(std::uint64_t count, double seconds) {
  return seconds > 0.0 ? static_cast<double>(count) / seconds : 0.0;
}

}  // namespace

SamplingReport::SamplingReport(const RenderResult& result, const RenderSettings& settings)
    : settings_(settings),
      part_(result.part),
      noise_(summarize_noise(result.film, result.part, settings.noise)),
      rays_(result.rays_traced),
      seconds_(result.seconds),
      is_out_of_time_(result.out_of_time) {
  const TileGrid grid(result.film.width(), result.film.height());
  paths_ = static_cast<std::uint64_t>(std::llround(noise_.mean_samples * static_cast<double>(part_.pixel_count(grid))));
}

std::string SamplingReport::samples() const {
  const std::uint32_t asked = settings_.samples_per_pixel;
  if (is_out_of_time_ || settings_.noise.is_on()) {
    if (noise_.least_samples == noise_.most_samples)
      return fmt::format("{} sample{} each", noise_.least_samples, noise_.least_samples == 1 ? "" : "s");
    return fmt::format("{} to {} samples, {:.1f} on average", noise_.least_samples, noise_.most_samples, noise_.mean_samples);
  }
  if (!part_.is_whole(asked)) return fmt::format("{} of {}", part_.text(), asked);
  return fmt::format("{} sample{} each", asked, asked == 1 ? "" : "s");
}

std::string SamplingReport::work() const {
  return fmt::format("{} rays and {} paths in {}: {} Mrays/s, {} Mpaths/s", with_separators(rays_), with_separators(paths_),
                     duration(seconds_), short_number(1e-6 * rate(rays_, seconds_)), short_number(1e-6 * rate(paths_, seconds_)));
}

std::string SamplingReport::remark() const {
  std::string text;
  if (settings_.noise.is_on()) {
    text = fmt::format("{:.1f} % of the pixels within {:g}, {:.3g} overall (root mean square)", 100.0 * noise_.share_within,
                       settings_.noise.target, noise_.root_mean_square);
  } else if (is_out_of_time_) {
    text = fmt::format("{:.3g} (root mean square over the pixels)", noise_.root_mean_square);
  }
  if (is_out_of_time_) text += "; the time limit ended it";
  return text;
}

void SamplingReport::add_to(nlohmann::ordered_json& json) const {
  json["paths"] = paths_;
  json["rays_per_s"] = rate(rays_, seconds_);
  json["paths_per_s"] = rate(paths_, seconds_);
  json["samples_taken"] = {{"least", noise_.least_samples}, {"mean", noise_.mean_samples}, {"most", noise_.most_samples}};
  // Of one sample a pixel nothing can be told; NaN becomes null.
  json["noise"] = {{"root_mean_square", noise_.root_mean_square}};
  if (settings_.noise.is_on()) {
    json["noise"]["target"] = settings_.noise.target;
    json["noise"]["share_within"] = noise_.share_within;
  }
  json["out_of_time"] = is_out_of_time_;
}

}  // namespace grove::app
