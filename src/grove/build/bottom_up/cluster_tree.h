#pragma once

#include <cstdint>

#include "grove/accel/bvh2.h"
#include "grove/build/bottom_up/subtree_cost.h"
#include "grove/build/primitive_reference.h"

namespace grove {

/// A subtree that may be joined with another, laid out as a reference: its number stands where a reference has its primitive, its cost in the last
/// lane of `upper`.
using Cluster = PrimitiveReference;

/// A binary tree that grows from its leaves by joining clusters, and then becomes a hierarchy.
///
/// Clusters are numbered: first come single references, then joined ones. What will be a leaf is decided when clusters are joined; so the nodes
/// below each are counted, and all parts of the hierarchy can be written to their places at the same time. Boxes are measured again then: keeping
/// them takes longer. 16 bytes a reference beside the references.
class ClusterTree {
 public:
  /// Of references in an order in which neighbours are near, at least one.
  ClusterTree(HugeVector<PrimitiveReference> references, const SubtreeCost& subtree_cost);

  [[nodiscard]] const HugeVector<PrimitiveReference>& references() const { return references_; }
  /// The cluster of one reference.
  [[nodiscard]] Cluster single(std::size_t reference) const {
    const Box4 box = references_[reference].box();
    return make_cluster(box, static_cast<std::uint32_t>(reference), subtree_cost_.of_reference(box));
  }

  /// Joins two clusters; the new one has the number references().size() + `join`. Different pairs may be joined at the same time, each under a
  /// `join` of its own below references().size() - 1.
  Cluster join(std::uint32_t join, const Cluster& left, const Cluster& right);

  /// The hierarchy below the last join, or of the only reference. Parallel; the same for any number of threads. O(n).
  [[nodiscard]] Bvh2 hierarchy(const Box& bounds) const;

 private:
  struct Size {
    std::uint32_t references;
    std::uint32_t nodes;  // 0 for a leaf
  };
  struct Pair {
    std::uint32_t left;
    std::uint32_t right;
    Size size;
  };
  struct Written {
    Box4 box;
    std::uint32_t height;
  };

  [[nodiscard]] static Cluster make_cluster(const Box4& box, std::uint32_t number, float cost) {
    return {with_last_lane_bits(box.lower, number), Float4{box.upper[0], box.upper[1], box.upper[2], cost}};
  }

  [[nodiscard]] bool is_single(std::uint32_t cluster) const { return cluster < references_.size(); }
  [[nodiscard]] const Pair& pair(std::uint32_t cluster) const { return pairs_[cluster - references_.size()]; }
  [[nodiscard]] Size size(std::uint32_t cluster) const { return is_single(cluster) ? Size{1, 0} : pair(cluster).size; }

  Written write(std::uint32_t cluster, Size place, Bvh2& bvh) const;
  Box4 write_leaf(std::uint32_t cluster, std::uint32_t* references) const;

  SubtreeCost subtree_cost_;
  HugeVector<PrimitiveReference> references_;
  HugeVector<Pair> pairs_;
};

}  // namespace grove
