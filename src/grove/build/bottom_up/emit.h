#pragma once

// From the topology of a binary hierarchy to its nodes: boxes are joined on the way back up, and subtrees become leaves there, where the cost model
// says so. Parallel by subtrees; deterministic.

#include <algorithm>
#include <concepts>
#include <utility>

#include "grove/base/parallel.h"
#include "grove/build/hierarchy_part.h"
#include "grove/build/primitive_reference.h"
#include "grove/build/split.h"

namespace grove {

/// A binary tree whose leaves are single references: subtrees are values of type T::Subtree.
template <typename T>
concept Topology = requires(const T& topology, const typename T::Subtree& subtree) {
  { topology.root() } -> std::same_as<typename T::Subtree>;
  { topology.count(subtree) } -> std::same_as<std::uint32_t>;  // references; a subtree of one is a leaf
  { topology.children(subtree) } -> std::same_as<std::pair<typename T::Subtree, typename T::Subtree>>;
  { topology.reference(subtree) } -> std::convertible_to<const PrimitiveReference&>;
};

struct BottomUpSettings {
  /// Subtrees of at most this many references may become leaves; they do where that costs no more. At least 1.
  std::uint32_t leaf_size = 8;
  CostModel cost = {};
  /// PLOC only: how far along the Morton curve a cluster looks for its nearest neighbour, in clusters.
  std::uint32_t radius = 8;
};

template <Topology T>
class HierarchyEmitter {
 public:
  using Subtree = typename T::Subtree;

  HierarchyEmitter(const T& topology, const BottomUpSettings& settings, float area_scale, std::uint32_t* ids)
      : topology_(topology), settings_(settings), area_scale_(area_scale), ids_(ids) {}

  /// Emits a subtree whose references start at place `first` of the references.
  HierarchyPart emit(const Subtree& subtree, std::uint32_t first, Box4& bounds) const {
    const std::uint32_t count = topology_.count(subtree);
    HierarchyPart part;
    if (count <= kTaskSize) {
      part.nodes.reserve(count);
      const Emitted emitted = emit_nodes(subtree, first, part.nodes);
      part.link = emitted.link;
      part.depth = emitted.height;
      part.nodes.shrink_to_fit();
      bounds = emitted.box;
      return part;
    }
    const auto [left, right] = topology_.children(subtree);
    const std::uint32_t right_first = first + topology_.count(left);
    parallel_invoke([&, l = left] { part.children[0] = std::make_unique<HierarchyPart>(emit(l, first, part.bounds[0])); },
                    [&, r = right] { part.children[1] = std::make_unique<HierarchyPart>(emit(r, right_first, part.bounds[1])); });
    part.depth = 1 + std::max(part.children[0]->depth, part.children[1]->depth);
    bounds = part.bounds[0];
    bounds.grow(part.bounds[1]);
    return part;
  }

 private:
  static constexpr std::uint32_t kTaskSize = 8192;

  struct Emitted {
    Bvh2Node::Child link;
    Box4 box;
    float cost;
    std::uint32_t height;
  };

  Emitted emit_nodes(const Subtree& subtree, std::uint32_t first, std::vector<Bvh2Node>& nodes) const {
    const std::uint32_t count = topology_.count(subtree);
    const auto test = static_cast<float>(settings_.cost.intersection);
    if (count == 1) {
      const PrimitiveReference& reference = topology_.reference(subtree);
      ids_[first] = reference.primitive();
      const Box4 box = reference.box();
      return {{first, 1}, box, test * scaled_half_area(box, area_scale_), 0};
    }
    const auto index = static_cast<std::uint32_t>(nodes.size());
    nodes.emplace_back();
    const auto [left, right] = topology_.children(subtree);
    const Emitted a = emit_nodes(left, first, nodes);
    const Emitted b = emit_nodes(right, first + topology_.count(left), nodes);
    Box4 box = a.box;
    box.grow(b.box);
    const float area = scaled_half_area(box, area_scale_);
    const float leaf_cost = test * area * static_cast<float>(count);
    const float cost = static_cast<float>(settings_.cost.traversal) * area + a.cost + b.cost;
    if (count <= settings_.leaf_size && leaf_cost <= cost) {
      nodes.resize(index);
      return {{first, count}, box, leaf_cost, 0};
    }
    set_children(nodes[index], a.box, b.box);
    nodes[index].child[0] = a.link;
    nodes[index].child[1] = b.link;
    return {{index, 0}, box, cost, 1 + std::max(a.height, b.height)};
  }

  const T& topology_;
  const BottomUpSettings& settings_;
  float area_scale_;
  std::uint32_t* ids_;
};

/// The hierarchy of a topology over `reference_count` references, at least one.
template <Topology T>
[[nodiscard]] Bvh2 emit_hierarchy(const T& topology, std::size_t reference_count, const Box& bounds, const BottomUpSettings& settings) {
  Bvh2 bvh;
  bvh.bounds = bounds;
  bvh.references.resize(reference_count);
  const HierarchyEmitter<T> emitter(topology, settings, AreaMeasure(bounds).scale(), bvh.references.data());
  Box4 unused;
  HierarchyPart root = emitter.emit(topology.root(), 0, unused);
  assemble(root, bvh);
  return bvh;
}

}  // namespace grove
