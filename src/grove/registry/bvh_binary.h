#pragma once

// The binary hierarchy that all forms of the family `bvh` start from.

#include <map>
#include <string_view>

#include "grove/build/bottom_up/lbvh.h"
#include "grove/build/bottom_up/ploc.h"
#include "grove/build/passes/collapse.h"
#include "grove/build/passes/reinsertion.h"
#include "grove/build/primitive_reference.h"
#include "grove/build/spatial_splits.h"
#include "grove/build/top_down.h"
#include "grove/registry/bvh_options.h"

namespace grove {

/// Where leaves are decided later, what is tested at once still need not be parted: parting it mostly costs more.
[[nodiscard]] inline std::uint32_t leaf_size_before_widening(const BvhOptions& options) {
  return options.leaves_are_decided_later() ? options.block_size : options.leaf_size;
}

/// How `options` want sets to be split from the top, by bins where they name a builder of another kind.
[[nodiscard]] inline TopDownSettings top_down_settings(const BvhOptions& options) {
  static const std::map<std::string_view, ObjectSplit> kObjectSplits = {{"binned", ObjectSplit::binned},
                                                                        {"sweep", ObjectSplit::sweep},
                                                                        {"object-median", ObjectSplit::object_median},
                                                                        {"spatial-median", ObjectSplit::spatial_median}};
  TopDownSettings settings;
  if (const auto found = kObjectSplits.find(options.split); found != kObjectSplits.end()) settings.split = found->second;
  if (options.cost == "equation-2") settings.cost.split_cost = SplitCost::equation_2;
  settings.leaf_size = leaf_size_before_widening(options);
  settings.cost.block_size = options.block_size;
  return settings;
}

/// Builds by the split that `options` name.
template <Geometry G>
[[nodiscard]] Bvh2 build_by_split(const G& geometry, const BvhOptions& options) {
  if (options.split == "lbvh" || options.split == "ploc") {
    BottomUpSettings settings;
    settings.leaf_size = leaf_size_before_widening(options);
    settings.cost.block_size = options.block_size;
    settings.radius = options.radius;
    ReferenceList list = list_references(geometry);
    return options.split == "lbvh" ? build_lbvh(list, settings) : build_ploc(std::move(list), settings);
  }
  TopDownSettings settings = top_down_settings(options);
  settings.duplication_budget = options.duplication_budget;
  settings.least_overlap_of_range = options.least_overlap_of_range;
  if (options.split == "spatial") return build_with_spatial_splits(geometry, settings);
  return build_top_down(list_references(geometry), settings);
}

/// How `options` want leaves and children decided after building.
[[nodiscard]] inline CollapseSettings collapse_settings(const BvhOptions& options) {
  CollapseSettings settings;
  settings.arity = options.arity;
  settings.leaf_size = options.leaf_size;
  settings.widening = options.widen == "greedy" ? Widening::greedy : Widening::optimal;
  return settings;
}

/// Builds the binary hierarchy over axis-aligned boxes that `options` ask for, before it is widened or bounded otherwise.
template <Geometry G>
[[nodiscard]] Bvh2 build_binary_hierarchy(const G& geometry, const BvhOptions& options) {
  Bvh2 bvh = build_by_split(geometry, options);
  if (options.optimize == "reinsertion") bvh = optimize_by_reinsertion(bvh, options.reinsertion);
  return bvh;
}

}  // namespace grove
