#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "grove/lab/spread.h"
#include "rivals/measurement.h"

namespace grove::bench::rivals {

/// What Grove's ways are set against: a group of ways of the rivals. The quickest of a group stands for it, scene by scene.
struct RivalGroup {
  std::string name;
  std::size_t call_size = 1;
  bool is_robust = false;
};
[[nodiscard]] std::span<const RivalGroup> rival_groups();

/// A way of Grove's beside the quickest of a group: the ratio of their rates, round by round.
struct Ratio {
  std::size_t call_size = 1;
  std::string structure;
  RayKind kind = RayKind::primary;
  int threads = 1;
  std::string group;
  std::string rival;  ///< the quickest, by its median
  Spread ratio;
};
[[nodiscard]] std::vector<Ratio> ratios_of(const SceneResult& result);

/// Everything that was measured of a scene and its ratios, as tables for a terminal.
[[nodiscard]] std::string text_of(const SceneResult& result);
/// Geometric means and worst scenes of the ratios' medians, one pinned thread and all.
[[nodiscard]] std::string summary_of(std::span<const SceneResult> results);
[[nodiscard]] nlohmann::ordered_json json_of(const SceneResult& result);

}  // namespace grove::bench::rivals
