#pragma once

#include <bit>
#include <cstdint>

#include "grove/accel/bvh2.h"
#include "grove/math/float4.h"

namespace grove {

/// A binary hierarchy in the form in which passes take it apart and put it together: slot 2 i + side is what node i has on that side, a box and
/// a link, and each node knows the slot that links to it. Nodes may stand in any order; node 0 is the root. 68 bytes a node.
struct SlotTree {
  static constexpr std::uint32_t kNone = 0xffffffffU;

  /// Bounds; the lanes left free hold the link as in Bvh2Node::Child.
  struct Slot {
    Float4 lower;  ///< lane 3: the bits of `first`
    Float4 upper;  ///< lane 3: the bits of `count`

    [[nodiscard]] Box4 box() const { return {without_last_lane(lower), without_last_lane(upper)}; }
    [[nodiscard]] Bvh2Node::Child link() const { return {std::bit_cast<std::uint32_t>(lower[3]), std::bit_cast<std::uint32_t>(upper[3])}; }
    void set_box(const Box4& box);
    void set(const Box4& box, Bvh2Node::Child link);
  };

  HugeVector<Slot> slots;
  HugeVector<std::uint32_t> parent_slot;  ///< of each node; kNone for the root
  HugeVector<std::uint32_t> references;
  Box bounds;

  /// Takes a hierarchy apart. O(nodes), parallel.
  explicit SlotTree(const Bvh2& bvh);

  /// Puts it together again in depth-first order. Where it is deeper than Bvh2::kMaxDepth, the leaves below depth 64 are put under balanced
  /// trees in the order in which they stand, which takes at most 31 more levels. O(nodes).
  [[nodiscard]] Bvh2 to_bvh2() const;

  [[nodiscard]] std::uint32_t node_count() const { return static_cast<std::uint32_t>(parent_slot.size()); }
};

}  // namespace grove
