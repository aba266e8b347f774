#pragma once

// The step of the dynamic program that collapses a binary hierarchy: Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed
// Wide BVHs" (2017), section 3.1, equations 2 to 6. What is known of a subtree are the least costs of replacing it by forests of at most 1, 2, … roots. They
// follow from those of its two children alone; so they go up the tree with whoever walks it, and only the choices stay behind, in a word a node.

#include <algorithm>
#include <cstdint>
#include <limits>

#include "grove/build/passes/collapse_settings.h"
#include "grove/math/float4.h"

namespace grove {

/// How the forests of one subtree come about, four bits each. The first: 0 for a leaf, else how many of the node's children come from its left
/// side. The others, for k roots: 0 when a root less is as good, else how many of them come from the left side.
class ForestChoices {
 public:
  [[nodiscard]] std::uint32_t of_roots(int roots) const { return word_ >> (4 * (roots - 1)) & 15U; }
  void set(int roots, std::uint32_t choice) { word_ |= choice << (4 * (roots - 1)); }

 private:
  std::uint32_t word_ = 0;
};

/// The least costs of replacing a subtree by at most k subtrees each of which is a leaf or a node, by the area of the scene's box.
class LeastForests {
 public:
  static constexpr int kMostRoots = CollapseSettings::kMaxArity - 1;

  LeastForests() { std::fill_n(costs_, kMostRoots + 9, std::numeric_limits<float>::infinity()); }

  /// Of a leaf of the binary hierarchy with the area `area`.
  void set_leaf(float area, std::uint32_t references, const CollapseSettings& settings) {
    std::fill_n(costs_ + kFirst, kMostRoots, area * settings.leaf_time(references));
    references_ = references;
    leaves_ = 1;
  }

  /// Of a node with the area `area` over two subtrees, either of which may be this object itself.
  ForestChoices join(const LeastForests& left, const LeastForests& right, float area, const CollapseSettings& settings);

 private:
  // costs_[kFirst + k - 1] is for k roots; before and behind these infinite, so that they can be read eight at a time from any place.
  static constexpr int kFirst = 8;

  alignas(16) float costs_[kMostRoots + 9];
  std::uint32_t references_ = 0;
  int leaves_ = 0;  // of the binary hierarchy, as far as that limits the roots
};

inline ForestChoices LeastForests::join(const LeastForests& left, const LeastForests& right, float area, const CollapseSettings& settings) {
  // Lane k - 2: the least cost of k roots in all, i of them from the left.
  Float4 least[2] = {splat(std::numeric_limits<float>::infinity()), splat(std::numeric_limits<float>::infinity())};
  Int4 from_left[2] = {Int4{1, 1, 1, 1}, Int4{1, 1, 1, 1}};
  for (int i = 1; i <= left.leaves_; ++i) {
    const Float4 cost_of_left = splat(left.costs_[kFirst + i - 1]);
    const Int4 choice = {i, i, i, i};
    for (int half = 0; half < 2; ++half) {
      const Float4 cost = cost_of_left + load4(right.costs_ + kFirst + 1 - i + 4 * half);
      const Int4 is_less = cost < least[half];
      least[half] = min(cost, least[half]);
      from_left[half] = (is_less & choice) | (~is_less & from_left[half]);
    }
  }
  const auto cost_of = [&](int roots) { return least[(roots - 2) / 4][(roots - 2) % 4]; };
  const auto choice_of = [&](int roots) { return static_cast<std::uint32_t>(from_left[(roots - 2) / 4][(roots - 2) % 4]); };

  const std::uint32_t references = left.references_ + right.references_;
  const int leaves = std::min(left.leaves_ + right.leaves_, kMostRoots);
  const float interior = area * static_cast<float>(settings.cost.traversal) + cost_of(settings.arity);
  const float leaf = references <= settings.leaf_size ? area * settings.leaf_time(references) : std::numeric_limits<float>::infinity();
  const bool is_leaf = leaf <= interior;
  ForestChoices choices;
  choices.set(1, is_leaf ? 0 : choice_of(settings.arity));
  float cost = is_leaf ? leaf : interior;
  costs_[kFirst] = cost;
  int roots = 2;
  for (; roots < settings.arity && roots <= leaves; ++roots) {
    const bool is_better = cost_of(roots) < cost;
    choices.set(roots, is_better ? choice_of(roots) : 0);
    cost = is_better ? cost_of(roots) : cost;
    costs_[kFirst + roots - 1] = cost;
  }
  for (; roots <= kMostRoots; ++roots) costs_[kFirst + roots - 1] = cost;
  references_ = references;
  leaves_ = leaves;
  return choices;
}

}  // namespace grove
