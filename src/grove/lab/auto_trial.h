#pragma once

#include <span>
#include <string>
#include <vector>

#include "grove/lab/structure_trial.h"
#include "grove/registry/choose_structure.h"

namespace grove {

/// What `auto` chose for one number of rays, and what would have been best.
struct AutoTrial {
  double rays = 0.0;
  StructureChoice choice;
  std::string winner;           ///< least time to build and trace that many rays
  double choice_seconds = 0.0;  ///< of the structure that was chosen
  double winner_seconds = 0.0;

  [[nodiscard]] bool picked_winner() const { return choice.structure == winner; }
  /// By how much longer the choice takes, relative to the winner: 0 where it is the winner.
  [[nodiscard]] double regret() const { return winner_seconds > 0.0 ? choice_seconds / winner_seconds - 1.0 : 0.0; }
};

/// Builds and traces all candidates and what `auto` chooses over the largest object of a scene, and tells for each number of rays how the choice fared, by medians over the
/// rounds. Structures are built and traced with settings.threads, so that one price list fits both. Throws as try_structures.
[[nodiscard]] std::vector<AutoTrial> try_auto(const Scene& scene, std::span<const std::string> candidates, std::span<const Ray> rays,
                                              std::span<const double> ray_counts, TrialSettings settings);

}  // namespace grove
