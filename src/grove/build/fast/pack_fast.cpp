#include "grove/build/fast/pack_fast.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "grove/base/check.h"
#include "grove/base/parallel.h"
#include "grove/build/fast/block_corners.h"
#include "grove/build/fast/child_orders.h"
#include "grove/build/fast/planned_nodes.h"

namespace grove {
namespace {

template <typename Block>
Block pack_block(std::span<const std::uint32_t> references, const TriangleMesh& mesh) {
  Block block;
  int places = 0;
  const auto append = [&](std::uint32_t primitive) {
    put_corners(mesh, primitive, places, block);
    block.primitive[places++] = primitive;
  };
  // Leaves that a collapse has joined may name a primitive more than once.
  for (const std::uint32_t primitive : references)
    if (std::find(block.primitive, block.primitive + places, primitive) == block.primitive + places) append(primitive);
  while (places < Block::kWidth) append(references[0]);
  return block;
}

template <typename Bvh>
class Packing {
  using Node = typename Bvh::Node;
  using Block = typename Bvh::Block;
  using Child = typename Bvh::Child;

 public:
  Packing(const Bvh2& binary, const TriangleMesh& mesh) : binary_(binary), mesh_(mesh) {}

  Bvh run(const CollapseSettings& settings) {
    if (binary_.references.empty()) return {};
    const CollapsePlan plan(binary_, settings);
    if (plan.root().count > 0) {
      pack_single_leaf();
    } else {
      pack_pieces(list_planned_nodes(binary_, plan));
    }
    result_.bounds = binary_.bounds;
    return std::move(result_);
  }

 private:
  // A root that is a leaf gets a node above it, so that a traversal always starts at a node.
  void pack_single_leaf() {
    result_ = Bvh(1, 1);
    result_.depth = 1;
    EightBoxes boxes = no_boxes();
    put_box(binary_.bounds, 0, boxes);
    set_boxes(boxes, 1, result_.nodes()[0]);
    for (Child& child : result_.nodes()[0].child) child = Child::node(0);
    result_.blocks()[0] = pack_block<Block>(binary_.references, mesh_);
    result_.references = result_.blocks()[0].count();
    result_.nodes()[0].child[0] = result_.leaf(0);
  }

  void pack_pieces(const std::vector<PlannedPiece>& pieces) {
    const PlannedPiece& last = pieces.back();
    result_ = Bvh(last.first_node + last.nodes.size(), last.first_block + last.block_count);
    std::vector<std::uint32_t> references(pieces.size(), 0);
    parallel_for(pieces.size(), 1, [&](std::size_t i) { references[i] = pack(pieces, pieces[i]); });
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      result_.references += references[i];
      result_.depth = std::max(result_.depth, pieces[i].depth);
    }
  }

  // Returns how many triangles the piece holds.
  std::uint32_t pack(const std::vector<PlannedPiece>& pieces, const PlannedPiece& piece) {
    std::uint32_t references = 0;
    std::size_t block = piece.first_block;
    for (std::size_t number = 0; number < piece.nodes.size(); ++number) {
      const PlannedNode planned = by_area(piece.nodes[number]);
      Node& node = result_.nodes()[piece.first_node + number];
      pack_boxes(planned, node);
      for (int i = 0; i < Node::kWidth; ++i) {
        if (planned.slot[i] == PlannedNode::kNoSlot) {
          node.child[i] = Child::node(0);
        } else if (planned.count[i] == 0) {
          node.child[i] = Child::node(piece.is_over_pieces ? pieces[planned.first[i]].first_node : piece.first_node + planned.first[i]);
        } else {
          GROVE_ASSERT(planned.count[i] <= Block::kWidth);
          result_.blocks()[block] = pack_block<Block>({binary_.references.data() + planned.first[i], planned.count[i]}, mesh_);
          references += result_.blocks()[block].count();
          node.child[i] = result_.leaf(block++);
        }
      }
    }
    return references;
  }

  // The same node with the smallest box in the first place and the largest in the last.
  [[nodiscard]] PlannedNode by_area(const PlannedNode& node) const {
    struct Place {
      float area;
      int place;
    };
    Place places[8];
    int count = 0;
    for (; count < Node::kWidth && node.slot[count] != PlannedNode::kNoSlot; ++count) {
      const std::uint32_t slot = node.slot[count];
      const Place next = {binary_.nodes[slot / 2].child_box(static_cast<int>(slot % 2)).half_area(), count};
      int place = count;
      for (; place > 0 && places[place - 1].area > next.area; --place) places[place] = places[place - 1];
      places[place] = next;
    }
    PlannedNode sorted = node;
    for (int i = 0; i < count; ++i) {
      sorted.slot[i] = node.slot[places[i].place];
      sorted.first[i] = node.first[places[i].place];
      sorted.count[i] = node.count[places[i].place];
    }
    return sorted;
  }

  void pack_boxes(const PlannedNode& planned, Node& node) const {
    EightBoxes boxes = no_boxes();
    int count = 0;
    for (; count < Node::kWidth && planned.slot[count] != PlannedNode::kNoSlot; ++count) {
      const std::uint32_t slot = planned.slot[count];
      const auto& planes = binary_.nodes[slot / 2].planes;
      for (int axis = 0; axis < 3; ++axis) {
        boxes.planes[axis][0][count] = planes[axis][slot % 2];
        boxes.planes[axis][1][count] = planes[axis][slot % 2 + 2];
      }
    }
    set_boxes(boxes, count, node);
  }

  static EightBoxes no_boxes() {
    EightBoxes boxes;
    for (auto& planes : boxes.planes) {
      std::fill_n(planes[0], Node::kWidth, std::numeric_limits<float>::infinity());
      std::fill_n(planes[1], Node::kWidth, -std::numeric_limits<float>::infinity());
    }
    return boxes;
  }

  static void put_box(const Box& box, int place, EightBoxes& boxes) {
    for (int axis = 0; axis < 3; ++axis) {
      boxes.planes[axis][0][place] = box.lower[axis];
      boxes.planes[axis][1][place] = box.upper[axis];
    }
  }

  static void set_boxes(const EightBoxes& boxes, int count, Node& node) {
    std::uint32_t orders[8];
    order_children(boxes, count, orders);
    node.set(boxes, count, orders);
  }

  const Bvh2& binary_;
  const TriangleMesh& mesh_;
  Bvh result_;
};

}  // namespace

template <typename Bvh>
Bvh pack_fast(const Bvh2& binary, const TriangleMesh& mesh, const CollapseSettings& settings) {
  CollapseSettings eight = settings;
  eight.arity = FastNode::kWidth;
  return Packing<Bvh>(binary, mesh).run(eight);
}
template FastBvh pack_fast(const Bvh2& binary, const TriangleMesh& mesh, const CollapseSettings& settings);
template CompressedFastBvh pack_fast(const Bvh2& binary, const TriangleMesh& mesh, const CollapseSettings& settings);

}  // namespace grove
