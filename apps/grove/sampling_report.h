#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "grove/render/render.h"

namespace grove::app {

/// What a render came to: how many samples and paths (a path begins with each sample), how quickly, and with how much noise.
class SamplingReport {
 public:
  SamplingReport(const RenderResult& result, const RenderSettings& settings);

  /// "64 samples each", or what part of them there is.
  [[nodiscard]] std::string samples() const;
  /// "1,234 rays and 56 paths in 7 s: 8 Mrays/s, 9 Mpaths/s"
  [[nodiscard]] std::string work() const;
  /// A line on noise and unequal numbers of samples; empty where there is nothing to say.
  [[nodiscard]] std::string remark() const;

  /// Adds the keys `paths`, `paths_per_s`, `rays_per_s`, `samples_taken`, `noise`, `out_of_time`.
  void add_to(nlohmann::ordered_json& json) const;

 private:
  RenderSettings settings_;
  PicturePart part_;
  NoiseSummary noise_;
  std::uint64_t paths_ = 0;
  std::uint64_t rays_ = 0;
  double seconds_ = 0.0;
  bool is_out_of_time_ = false;
};

}  // namespace grove::app
