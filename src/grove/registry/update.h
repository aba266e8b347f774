#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace grove {

/// How a structure follows its geometry. Kd-trees that are told what changed take it out of leaves and put it into others by all of these but `rebuild`, and
/// build subtrees anew only where it is `automatic`.
enum class UpdatePolicy : std::uint8_t {
  automatic,  ///< refits and rotates, then rebuilds parts or all where that is predicted to pay (build/passes/partial_rebuild.h)
  refit,      ///< measures boxes anew and leaves the topology
  rotate,     ///< refits, then rotates (build/passes/rotation.h)
  rebuild,    ///< builds anew
};

/// What an update did. `rotate` includes a refit, `partial_rebuild` both.
enum class UpdateMethod : std::uint8_t {
  refit,
  rotate,
  partial_rebuild,
  local,  ///< references were taken out of leaves and put into others, which were split or merged where that paid
  rebuild
};

/// "auto", "refit", "rotate", "rebuild".
[[nodiscard]] std::string_view name_of(UpdatePolicy policy);
/// "refit", "rotate", "partial rebuild", "local", "rebuild".
[[nodiscard]] std::string_view name_of(UpdateMethod method);
/// Throws UsageError that lists the names.
[[nodiscard]] UpdatePolicy parse_update_policy(std::string_view name);

struct UpdateSettings {
  UpdatePolicy policy = UpdatePolicy::automatic;
  /// How many rays will be traced before the next update: the more, the sooner rebuilding pays. Used by `automatic`.
  double rays = 1e6;
  /// Numbers of the primitives that were added, removed or moved since the structure was built or last updated, in any order, repeats allowed. All
  /// others must be as they were: a structure may look at none but these. Empty: any may have changed.
  std::span<const std::uint32_t> changed = {};
};

/// Throws InputError for more primitives than a structure may have, which is 2^31 - 1.
void check_primitive_count(std::size_t count);
/// Throws InputError when a structure that knows `known` primitives cannot follow a geometry that now has `count`, or settings.changed names others.
void check_update(std::size_t known, std::size_t count, const UpdateSettings& settings);

struct UpdateReport {
  UpdateMethod method = UpdateMethod::rebuild;
  double built_cost = 0.0;     ///< expected cost when the structure was last built as a whole
  double refitted_cost = 0.0;  ///< after refitting alone; 0 where that was not done
  double cost = 0.0;           ///< now
  std::uint64_t rotations = 0;
  std::uint64_t rebuilt_references = 0;  ///< in the parts that were built anew
  double seconds = 0.0;                  ///< wall clock

  /// By how much an average ray has become dearer since the structure was last built as a whole: 1 means not at all.
  [[nodiscard]] double cost_growth() const { return built_cost > 0.0 ? cost / built_cost : 1.0; }
};

}  // namespace grove
