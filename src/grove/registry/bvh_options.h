#pragma once

#include <cstdint>
#include <string>

#include "grove/build/passes/reinsertion.h"
#include "grove/registry/spec.h"

namespace grove {

/// What a spec of the family `bvh` asks for.
struct BvhOptions {
  explicit BvhOptions(const Spec& spec);

  std::string split;
  std::string cost;
  std::string bounds;
  int arity = 2;
  std::string widen;
  std::string optimize;
  std::uint32_t leaf_size = 8;
  std::uint32_t radius = 8;
  /// So many primitives are tested at once (CostModel::block_size); no spec says so.
  std::uint32_t block_size = 1;
  /// What else builders and passes leave to choose, and no spec says.
  double duplication_budget = 1.0;
  double least_overlap_of_range = 0.0;
  ReinsertionSettings reinsertion;

  /// Whether later passes decide which references share a leaf, so that the builder must part them all.
  [[nodiscard]] bool leaves_are_decided_later() const { return arity > 2 || bounds != "aabb" || optimize != "none"; }
};

}  // namespace grove
