#pragma once

// What the top-down driver knows of a split, and what a heuristic must offer to be driven.

#include <bit>
#include <concepts>
#include <cstdint>
#include <span>

#include "grove/build/cost_model.h"
#include "grove/build/reference_range.h"

namespace grove {

/// Where a reference goes. `both` only with heuristics that divide references.
enum class Side : std::uint8_t { left, right, both };

/// A way to part a range in two, as far as the driver needs to know it. Heuristics derive their own and add side().
struct Split {
  bool is_possible = false;
  /// Sum over both sides of half area (scaled) times the time expected inside (SubsetTime).
  float cost = 0.0F;
  Box4 left = Box4::empty();
  Box4 right = Box4::empty();
  std::uint32_t left_count = 0;
  std::uint32_t right_count = 0;  ///< left_count + right_count exceeds the range's count by the references on both sides
};

/// The time expected for a ray inside one subset of a partition, as the cost of a split sees it.
///
/// - SplitCost::standard: only the tests of its references, in whole blocks, which is today's usual form.
/// - SplitCost::equation_2: besides, the time t_i of traversing the subtree, as in equation 2 of the review (MacDonald and Booth 1990):
///   one step and one more for each level of a balanced tree.
class SubsetTime {
 public:
  explicit SubsetTime(const CostModel& model)
      : model_(model),
        per_reference_(static_cast<float>(model.intersection)),
        per_level_(model.split_cost == SplitCost::equation_2 ? static_cast<float>(model.traversal) : 0.0F) {}

  /// Of four subsets.
  [[nodiscard]] Float4 operator()(Int4 counts) const {
    const auto rest = static_cast<std::int32_t>(model_.block_size) - 1;
    const Int4 in_whole_blocks = (counts + rest) & ~rest;
    Float4 time = splat(per_reference_) * __builtin_convertvector(in_whole_blocks, Float4);
    if (per_level_ > 0.0F)
      for (int i = 0; i < 4; ++i) time[i] += per_level_ * static_cast<float>(std::bit_width(static_cast<std::uint32_t>(counts[i])));
    return time;
  }

  [[nodiscard]] float operator()(std::uint32_t count) const {
    return per_reference_ * static_cast<float>(model_.in_whole_blocks(count)) + per_level_ * static_cast<float>(std::bit_width(count));
  }

 private:
  CostModel model_;
  float per_reference_;
  float per_level_;
};

/// What all splits of one build share.
struct SplitContext {
  float area_scale;  ///< AreaMeasure::scale of the whole scene
  SubsetTime time;
};

/// Half the surface area of a box in scaled units.
[[nodiscard]] inline float scaled_half_area(const Box4& box, float scale) {
  const Float4 d = (box.upper - box.lower) * splat(scale);
  return d[0] * (d[1] + d[2]) + d[1] * d[2];
}

/// A heuristic finds a split of a range and tells each reference's side. It is shared by all tasks, so it is const; what a task needs for
/// itself is in Scratch. The result of `find` and `find_in_parallel` for a range depends on the range's references alone.
template <typename H>
concept SplitHeuristic = requires(const H& heuristic, const ReferenceRange& range, std::span<const PrimitiveReference> references,
                                  const typename H::Split& split, typename H::Scratch& scratch) {
  requires std::derived_from<typename H::Split, Split>;
  { heuristic.find(range, references, scratch) } -> std::same_as<typename H::Split>;
  { heuristic.find_in_parallel(range, references) } -> std::same_as<typename H::Split>;
  { split.side(references[0]) } -> std::same_as<Side>;
  { H::kDividesReferences } -> std::convertible_to<bool>;
};

/// Borders of chunks in which large ranges are handled in parallel.
inline constexpr std::size_t kBuildChunkSize = 16384;

}  // namespace grove
