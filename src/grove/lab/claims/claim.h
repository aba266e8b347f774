#pragma once

// A claim of the review, and the experiment that checks it.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "grove/lab/claims/effort.h"
#include "grove/lab/report_section.h"

namespace grove {

enum class Verdict : std::uint8_t { holds, fails, mixed };

/// "holds", "fails", "mixed".
[[nodiscard]] std::string_view name_of(Verdict verdict);

/// What an experiment found.
struct Finding {
  Verdict verdict = Verdict::mixed;
  /// A sentence or two with the figures that decide.
  std::string measured;
  /// What explains it, by counts; empty where it explains itself.
  std::string why = {};
  std::vector<ReportSection> sections = {};
};

struct Claim {
  std::string_view id;         ///< words with dashes
  std::string_view statement;  ///< what the review says, in one sentence
  std::string_view source;     ///< its section or equation
  std::string_view method;     ///< what is measured, and from which figures on the claim holds
  /// Runs in the caller's oneTBB arena. Throws Stopped where effort.stop asks.
  Finding (*check)(const Effort& effort);
};

/// All claims, in the order of the review.
[[nodiscard]] std::span<const Claim> review_claims();

// Each file of experiments lists its claims.
[[nodiscard]] std::span<const Claim> octree_claims();
[[nodiscard]] std::span<const Claim> octree_form_claims();
[[nodiscard]] std::span<const Claim> kd_tree_claims();
[[nodiscard]] std::span<const Claim> hierarchy_claims();
[[nodiscard]] std::span<const Claim> heuristic_claims();
[[nodiscard]] std::span<const Claim> cost_model_claims();
[[nodiscard]] std::span<const Claim> construction_claims();
[[nodiscard]] std::span<const Claim> octree_r_claims();
[[nodiscard]] std::span<const Claim> movement_claims();
[[nodiscard]] std::span<const Claim> auto_claims();

/// `all` where the claim is true of all cases, `none` of none; mixed between.
[[nodiscard]] inline Verdict verdict_by_cases(std::size_t true_of, std::size_t cases) {
  return true_of == cases ? Verdict::holds : true_of == 0 ? Verdict::fails : Verdict::mixed;
}

}  // namespace grove
