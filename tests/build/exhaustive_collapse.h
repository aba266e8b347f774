#pragma once

// The least cost of collapsing a small binary hierarchy, by trying all there are: each interior node stays, is opened into the node above, or
// becomes a leaf. O(3^nodes).

#include <limits>
#include <optional>

#include "grove/build/passes/collapse.h"

namespace grove::testing {

class ExhaustiveCollapse {
 public:
  ExhaustiveCollapse(const Bvh2& bvh, const CollapseSettings& settings)
      : bvh_(bvh), settings_(settings), measure_(bvh.bounds), fate_(bvh.nodes.size(), Fate::stays) {}

  /// In units of expected_cost.
  [[nodiscard]] double least_cost() {
    std::size_t combinations = 1;
    for (std::size_t i = 0; i < fate_.size(); ++i) combinations *= 3;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t combination = 0; combination < combinations; ++combination) {
      std::size_t digits = combination;
      for (Fate& fate : fate_) {
        fate = static_cast<Fate>(digits % 3);
        digits /= 3;
      }
      if (fate_[0] == Fate::is_opened) continue;
      const std::optional<double> cost = cost_of(0, measure_.half_area(bvh_.bounds));
      if (cost && *cost < least) least = *cost;
    }
    return least / measure_.half_area(bvh_.bounds);
  }

 private:
  enum class Fate { stays, is_opened, is_leaf };

  [[nodiscard]] std::uint32_t count(const Bvh2Node::Child& link) const {
    if (link.count > 0) return link.count;
    return count(bvh_.nodes[link.first].child[0]) + count(bvh_.nodes[link.first].child[1]);
  }

  // Nothing where the combination is not allowed.
  [[nodiscard]] std::optional<double> cost_of(std::uint32_t node, double area) const {
    if (fate_[node] == Fate::is_leaf) {
      const std::uint32_t references = count({node, 0});
      if (references > settings_.leaf_size) return std::nullopt;
      return settings_.cost.intersection * references * area;
    }
    double cost = settings_.cost.traversal * area;
    int children = 0;
    if (!add_children(node, cost, children) || children > settings_.arity) return std::nullopt;
    return cost;
  }

  bool add_children(std::uint32_t node, double& cost, int& children) const {
    for (int side = 0; side < 2; ++side) {
      const Bvh2Node::Child link = bvh_.nodes[node].child[side];
      const double area = measure_.half_area(bvh_.nodes[node].child_box(side));
      if (link.count == 0 && fate_[link.first] == Fate::is_opened) {
        if (!add_children(link.first, cost, children)) return false;
        continue;
      }
      ++children;
      if (link.count > 0) {
        cost += settings_.cost.intersection * link.count * area;
      } else {
        const std::optional<double> below = cost_of(link.first, area);
        if (!below) return false;
        cost += *below;
      }
    }
    return true;
  }

  const Bvh2& bvh_;
  const CollapseSettings& settings_;
  AreaMeasure measure_;
  std::vector<Fate> fate_;
};

}  // namespace grove::testing
