#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

#include "grove/accel/fast_child.h"
#include "grove/math/box.h"

namespace grove {

/// The planes of eight boxes by axis, side (lower and upper) and place.
struct EightBoxes {
  float planes[3][2][8];

  [[nodiscard]] Box box(int i) const {
    return {{planes[0][0][i], planes[1][0][i], planes[2][0][i]}, {planes[0][1][i], planes[1][1][i], planes[2][1][i]}};
  }
};

/// An interior node with up to eight children, in four cache lines. Their boxes grow from place to place: a search for any hit begins with the last, where
/// it is likeliest to find one.
///
///   bytes   0..191  bounds of the children; unused places have an inverted infinite box, which no ray meets
///   bytes 192..223  child[i]
///   bytes 224..255  order[octant]: the places of the children from far to near for rays whose direction has negative components where the
///                   bits of `octant` are set (bit 0 for x), three bits each, the farthest in the lowest; unused places come first
struct alignas(64) FastNode {
  static constexpr int kWidth = 8;
  using Child = BasicFastChild<8>;

  EightBoxes bounds;
  Child child[kWidth];
  std::uint32_t order[kWidth];

  /// The boxes of all children; inverted and infinite where there is none.
  [[nodiscard]] const EightBoxes& boxes() const { return bounds; }
  [[nodiscard]] Box child_box(int i) const { return bounds.box(i); }
  [[nodiscard]] bool has_child(int i) const { return bounds.planes[0][0][i] <= bounds.planes[0][1][i]; }
  [[nodiscard]] std::uint32_t order_for(std::uint32_t octant) const { return order[octant]; }
  /// How far a child's box may be larger than what it holds.
  [[nodiscard]] float looseness() const { return 0.0F; }

  /// Takes children in the first `count` places with their boxes; those behind them are inverted. Orders are as above.
  void set(const EightBoxes& boxes, int count, const std::uint32_t orders[8]);
};

static_assert(sizeof(FastNode) == 256);
static_assert(sizeof(FastNode) == FastNode::Child::kNodeUnits * sizeof(FastUnit));

/// The same in two cache lines: planes are whole steps on a grid of the node's own, rounded outwards, so that no ray is lost. The idea of a grid with
/// steps of powers of two is from Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs" (2017), section 3.2.
///
///   bytes   0..47   steps[axis][0][i], steps[axis][1][i]: a plane of child i is at  origin + step * scale
///   bytes  48..59   origin
///   bytes  60..65   scale by axis: the upper halves of floats, powers of two
///   bytes  66..67   which places are used: as they are, and as orders have them
///   bytes  68..99   child[i]
///   bytes 100..123  orders as in FastNode, in three bytes each
struct alignas(64) CompressedNode {
  static constexpr int kWidth = 8;
  using Child = BasicFastChild<4>;

  std::uint8_t steps[3][2][kWidth];
  float origin[3];
  std::uint16_t scale[3];
  std::uint8_t used;
  std::uint8_t used_in_order;
  Child child[kWidth];
  std::uint8_t order[3 * kWidth];
  std::uint8_t unused[4];

  [[nodiscard]] float scale_along(int axis) const { return std::bit_cast<float>(std::uint32_t{scale[axis]} << 16); }
  [[nodiscard]] bool has_child(int i) const { return (used >> i & 1) != 0; }
  /// The boxes of all children in floats, rounded outwards; inverted and infinite where there is none.
  [[nodiscard]] EightBoxes boxes() const;
  [[nodiscard]] Box child_box(int i) const { return boxes().box(i); }
  /// Its highest byte means nothing.
  [[nodiscard]] std::uint32_t order_for(std::uint32_t octant) const {
    std::uint32_t word;
    std::memcpy(&word, order + 3 * octant, sizeof word);
    return word;
  }
  [[nodiscard]] float looseness() const;

  void set(const EightBoxes& boxes, int count, const std::uint32_t orders[8]);
};

static_assert(sizeof(CompressedNode) == 128);
static_assert(sizeof(CompressedNode) == CompressedNode::Child::kNodeUnits * sizeof(FastUnit));

}  // namespace grove
