#include "grove/accel/fast_bvh.h"

#include <algorithm>

#include "grove/base/error.h"

namespace grove {
namespace {

bool is_permutation(std::uint32_t order) {
  unsigned seen = 0;
  for (int k = 0; k < FastNode::kWidth; ++k) seen |= 1U << (order >> (3 * k) & 7U);
  return seen == 0xffU;
}

bool names_vertices(const TriangleBlock& /*block*/, std::size_t /*count*/) {
  return true;
}

bool names_vertices(const IndexedBlock& block, std::size_t count) {
  return std::all_of(&block.vertex[0][0], &block.vertex[0][0] + 3 * IndexedBlock::kWidth,
                     [&](std::uint32_t vertex) { return vertex < count; });
}

// A box on a node's grid may reach out of the one that its parent has for it, by a step of the grid.
Box widened(const Box& box, float looseness) {
  return {box.lower - Vec3(looseness), box.upper + Vec3(looseness)};
}

template <typename Bvh>
class Validation {
  using Node = typename Bvh::Node;
  using Block = typename Bvh::Block;
  using Child = typename Bvh::Child;

 public:
  Validation(const Bvh& bvh, std::size_t primitive_count, std::span<const Vec3> vertices)
      : bvh_(bvh),
        primitive_count_(primitive_count),
        vertices_(vertices),
        node_is_reached_(bvh.nodes().size(), false),
        block_is_reached_(bvh.blocks().size(), false) {}

  std::string run() {
    if (bvh_.empty()) return bvh_.blocks().empty() && bvh_.references == 0 ? "" : "triangles without a root";
    check_node(0, bvh_.bounds, 0);
    if (error_.empty() && std::find(node_is_reached_.begin(), node_is_reached_.end(), false) != node_is_reached_.end())
      error_ = "a node is not reached";
    if (error_.empty() && std::find(block_is_reached_.begin(), block_is_reached_.end(), false) != block_is_reached_.end())
      error_ = "a block is not reached";
    if (error_.empty() && depth_ != bvh_.depth) error_ = "depth is " + std::to_string(depth_) + ", not " + std::to_string(bvh_.depth);
    if (error_.empty() && references_ != bvh_.references) error_ = "references are " + std::to_string(references_);
    return error_;
  }

 private:
  void check_node(std::uint32_t number, const Box& box, std::uint32_t depth) {
    if (number >= bvh_.nodes().size() || node_is_reached_[number]) return fail("node", number, "is not there, or reached twice");
    node_is_reached_[number] = true;
    const Node& node = bvh_.nodes()[number];
    const EightBoxes boxes = node.boxes();
    for (std::uint32_t octant = 0; octant < 8; ++octant)
      if (!is_permutation(node.order_for(octant))) return fail("node", number, "has an order that is none");
    for (int i = 0; i < Node::kWidth && error_.empty(); ++i) {
      if (!node.has_child(i)) continue;
      const Child child = node.child[i];
      if (!widened(box, 2.0F * node.looseness()).contains(boxes.box(i))) return fail("node", number, "has a child outside of it");
      if (child.is_leaf()) {
        check_block(child, boxes.box(i), depth + 1);
      } else if (child.node() <= number) {
        fail("node", number, "has a child before it");
      } else {
        check_node(child.node(), boxes.box(i), depth + 1);
      }
    }
  }

  void check_block(Child leaf, const Box& box, std::uint32_t depth) {
    depth_ = std::max(depth_, depth);
    const std::size_t first = bvh_.nodes().size() * Child::kNodeUnits;
    const std::size_t number = (leaf.unit() - first) / Block::kUnits;
    if (leaf.unit() < first || bvh_.leaf(number).unit() != leaf.unit() || number >= bvh_.blocks().size() || block_is_reached_[number])
      return fail("block", leaf.unit(), "is not there, or reached twice");
    block_is_reached_[number] = true;
    if (!names_vertices(bvh_.block(leaf), vertices_.size())) return fail("block", leaf.unit(), "names a vertex that is not there");
    const TriangleBlock& block = gathered(bvh_.block(leaf), vertices_.data());
    references_ += block.count();
    for (std::uint32_t place = 0; place < TriangleBlock::kWidth; ++place) {
      if (block.primitive[place] >= primitive_count_) return fail("block", leaf.unit(), "names a primitive that is not there");
      Box triangle;
      for (int corner = 0; corner < 3; ++corner)
        triangle.grow(Vec3(block.corners[0][corner][place], block.corners[1][corner][place], block.corners[2][corner][place]));
      if (box.intersection(triangle).is_empty()) return fail("block", leaf.unit(), "has a triangle outside of its box");
    }
  }

  void fail(const char* what, std::uint32_t number, const char* how) {
    if (error_.empty()) error_ = std::string(what) + " " + std::to_string(number) + " " + how;
  }

  const Bvh& bvh_;
  std::size_t primitive_count_;
  std::span<const Vec3> vertices_;
  std::vector<bool> node_is_reached_;
  std::vector<bool> block_is_reached_;
  std::uint32_t depth_ = 0;
  std::uint32_t references_ = 0;
  std::string error_;
};

}  // namespace

template <typename NodeFormat, typename BlockFormat>
BasicFastBvh<NodeFormat, BlockFormat>::BasicFastBvh(std::size_t node_count, std::size_t block_count)
    : node_count_(node_count), block_count_(block_count) {
  const std::size_t size = first_block() + block_count * Block::kUnits;
  if (size > Child::kMostUnits)
    throw Error("the fast path holds up to 32 GiB of nodes and triangles; divide the scene into instances, or use 'bvh'");
  units_.resize(size);
}

template <typename NodeFormat, typename BlockFormat>
std::string BasicFastBvh<NodeFormat, BlockFormat>::validate(std::size_t primitive_count, std::span<const Vec3> mesh_vertices) const {
  return Validation<BasicFastBvh>(*this, primitive_count, mesh_vertices).run();
}

template class BasicFastBvh<FastNode, TriangleBlock>;
template class BasicFastBvh<CompressedNode, IndexedBlock>;

}  // namespace grove
