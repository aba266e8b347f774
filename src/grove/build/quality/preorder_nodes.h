#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "grove/base/huge_vector.h"
#include "grove/math/box.h"

namespace grove {

/// The nodes of any hierarchy in depth-first order, parents first, each with where its subtree ends: what the quality figures are computed
/// from, whatever the arity. A walk goes on at the next node to enter this one and at `end` to leave it out.
class PreorderNodes {
 public:
  struct Node {
    Box box;
    std::uint32_t end;              ///< number of the first node behind the subtree
    std::uint32_t first_reference;  ///< the references of the whole subtree, in depth-first order
    std::uint32_t reference_count;
  };

  /// Lists what `hierarchy.visit(box, depth, first, count)` shows in depth-first order, and `hierarchy.references`, all of them below
  /// `primitive_count`. O(nodes + references + primitives).
  template <typename Hierarchy>
  PreorderNodes(const Hierarchy& hierarchy, std::size_t primitive_count);

  [[nodiscard]] std::span<const Node> nodes() const { return nodes_; }
  [[nodiscard]] bool is_leaf(std::uint32_t node) const { return nodes_[node].end == node + 1; }
  [[nodiscard]] std::size_t reference_count() const { return references_.size(); }

  /// How many primitives are referenced at all.
  [[nodiscard]] std::size_t referenced_primitive_count() const;
  /// References over primitives that are referenced; nothing without any.
  [[nodiscard]] std::optional<double> duplication() const;
  /// Whether any leaf of the subtree names the primitive. O(log of how often the primitive is referenced).
  [[nodiscard]] bool holds(const Node& node, std::uint32_t primitive) const;

 private:
  void close(std::vector<std::uint32_t>& open, std::size_t depth);
  void index_primitives(std::size_t primitive_count);

  HugeVector<Node> nodes_;
  HugeVector<std::uint32_t> references_;
  // Where primitive p is referenced: places_[first_place_[p]] up to places_[first_place_[p + 1]], ascending.
  HugeVector<std::uint32_t> first_place_;
  HugeVector<std::uint32_t> places_;
};

template <typename Hierarchy>
PreorderNodes::PreorderNodes(const Hierarchy& hierarchy, std::size_t primitive_count) {
  references_.reserve(hierarchy.references.size());
  std::vector<std::uint32_t> open;  // the nodes from the root to the last one seen
  hierarchy.visit([&](const Box& box, std::uint32_t depth, std::uint32_t first, std::uint32_t count) {
    close(open, depth);
    open.push_back(static_cast<std::uint32_t>(nodes_.size()));
    nodes_.push_back({box, 0, static_cast<std::uint32_t>(references_.size()), 0});
    for (std::uint32_t i = first; i < first + count; ++i) references_.push_back(hierarchy.references[i]);
  });
  close(open, 0);
  index_primitives(primitive_count);
}

}  // namespace grove
