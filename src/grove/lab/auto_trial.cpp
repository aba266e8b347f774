#include "grove/lab/auto_trial.h"

#include <algorithm>

#include "grove/lab/largest_object.h"
#include "grove/lab/spread.h"

namespace grove {
namespace {

double seconds_of(const StructureTrial& trial, double rays) {
  return spread_of(trial.build_seconds).median + 1e-9 * rays * spread_of(trial.nanoseconds).median;
}

}  // namespace

std::vector<AutoTrial> try_auto(const Scene& scene, std::span<const std::string> candidates, std::span<const Ray> rays,
                                std::span<const double> ray_counts, TrialSettings settings) {
  const Object* const object = largest_object(scene);
  if (object == nullptr) return {};
  const GeometrySample sample = sample_geometry(geometry_of(*object));
  std::vector<std::string> specs;
  for (const std::string& candidate : candidates) specs.push_back(canonical_spec(candidate));
  std::vector<AutoTrial> result;
  for (const double count : ray_counts) {
    AutoTrial& one = result.emplace_back();
    one.rays = count;
    one.choice = choose_structure(sample, {StructureUse::Kind::still, count});
    if (std::ranges::find(specs, one.choice.structure) == specs.end()) specs.push_back(one.choice.structure);
  }
  settings.build_threads = settings.threads;
  const std::vector<StructureTrial> trials = try_structures(scene, specs, rays, settings);
  for (AutoTrial& one : result) {
    const auto time = [&](const StructureTrial& trial) { return seconds_of(trial, one.rays); };
    const auto winner = std::ranges::min_element(trials, {}, time);
    one.winner = winner->structure;
    one.winner_seconds = time(*winner);
    one.choice_seconds = time(*std::ranges::find(trials, one.choice.structure, &StructureTrial::structure));
  }
  return result;
}

}  // namespace grove
