#include "grove/build/passes/slot_tree.h"

#include <algorithm>

#include "grove/base/parallel.h"
#include "grove/build/hierarchy_part.h"

namespace grove {
namespace {

constexpr std::uint32_t kBalanceDepth = 64;

// Emits nodes in depth-first order.
class Emitter {
 public:
  Emitter(const SlotTree& tree, Bvh2& bvh) : tree_(tree), bvh_(bvh) {
    bvh_.nodes.reserve(tree.node_count());
    bvh_.references.reserve(tree.references.size());
    measure_heights();
  }

  void run() {
    struct Entry {
      Bvh2Node::Child link;
      std::uint32_t parent;
      int side;
      std::uint32_t depth;
    };
    std::vector<Entry> stack{{{0, 0}, SlotTree::kNone, 0, 0}};
    while (!stack.empty()) {
      const Entry top = stack.back();
      stack.pop_back();
      const Bvh2Node::Child link = emit(top.link, top.depth);
      if (top.parent != SlotTree::kNone) bvh_.nodes[top.parent].child[top.side] = link;
      if (top.link.count > 0 || is_balanced_at(top.link.first, top.depth)) continue;
      const std::uint32_t number = link.first;
      for (int side = 1; side >= 0; --side) {
        const SlotTree::Slot& slot = tree_.slots[2 * top.link.first + static_cast<std::uint32_t>(side)];
        stack.push_back({slot.link(), number, side, top.depth + 1});
      }
    }
  }

 private:
  [[nodiscard]] bool is_balanced_at(std::uint32_t node, std::uint32_t depth) const {
    return depth == kBalanceDepth && heights_[node] > Bvh2::kMaxDepth - kBalanceDepth;
  }

  // Emits a leaf, or a node without its links, or a balanced tree.
  Bvh2Node::Child emit(const Bvh2Node::Child& link, std::uint32_t depth) {
    if (link.count > 0) return emit_leaf(link, depth);
    if (is_balanced_at(link.first, depth)) {
      std::vector<SlotTree::Slot> leaves;
      gather_leaves(link.first, leaves);
      return emit_balanced(leaves, 0, leaves.size(), depth);
    }
    const auto number = static_cast<std::uint32_t>(bvh_.nodes.size());
    set_children(bvh_.nodes.emplace_back(), tree_.slots[2 * link.first].box(), tree_.slots[2 * link.first + 1].box());
    return {number, 0};
  }

  Bvh2Node::Child emit_leaf(const Bvh2Node::Child& link, std::uint32_t depth) {
    bvh_.depth = std::max(bvh_.depth, depth);
    const auto first = static_cast<std::uint32_t>(bvh_.references.size());
    for (std::uint32_t i = link.first; i < link.first + link.count; ++i) bvh_.references.push_back(tree_.references[i]);
    return {first, link.count};
  }

  void gather_leaves(std::uint32_t root, std::vector<SlotTree::Slot>& leaves) const {
    std::vector<std::uint32_t> stack{2 * root + 1, 2 * root};
    while (!stack.empty()) {
      const SlotTree::Slot& slot = tree_.slots[stack.back()];
      stack.pop_back();
      if (slot.link().count > 0) {
        leaves.push_back(slot);
      } else {
        stack.push_back(2 * slot.link().first + 1);
        stack.push_back(2 * slot.link().first);
      }
    }
  }

  Bvh2Node::Child emit_balanced(const std::vector<SlotTree::Slot>& leaves, std::size_t first, std::size_t last, std::uint32_t depth) {
    if (last - first == 1) return emit_leaf(leaves[first].link(), depth);
    const std::size_t middle = first + (last - first) / 2;
    Box4 boxes[2] = {Box4::empty(), Box4::empty()};
    for (std::size_t i = first; i < last; ++i) boxes[i < middle ? 0 : 1].grow(leaves[i].box());
    const auto number = static_cast<std::uint32_t>(bvh_.nodes.size());
    set_children(bvh_.nodes.emplace_back(), boxes[0], boxes[1]);
    const Bvh2Node::Child left = emit_balanced(leaves, first, middle, depth + 1);
    const Bvh2Node::Child right = emit_balanced(leaves, middle, last, depth + 1);
    bvh_.nodes[number].child[0] = left;
    bvh_.nodes[number].child[1] = right;
    return {number, 0};
  }

  // Edges from each node to its deepest leaf: parents come before children in `order`.
  void measure_heights() {
    std::vector<std::uint32_t> order{0};
    order.reserve(tree_.node_count());
    for (std::size_t i = 0; i < order.size(); ++i) {
      for (std::uint32_t side = 0; side < 2; ++side) {
        const Bvh2Node::Child link = tree_.slots[2 * order[i] + side].link();
        if (link.count == 0) order.push_back(link.first);
      }
    }
    heights_.assign(tree_.node_count(), 1);
    for (std::size_t i = order.size(); i-- > 1;) {
      const std::uint32_t parent = tree_.parent_slot[order[i]] / 2;
      heights_[parent] = std::max(heights_[parent], heights_[order[i]] + 1);
    }
  }

  const SlotTree& tree_;
  Bvh2& bvh_;
  std::vector<std::uint32_t> heights_;
};

}  // namespace

void SlotTree::Slot::set_box(const Box4& box) {
  set(box, link());
}

void SlotTree::Slot::set(const Box4& box, Bvh2Node::Child link) {
  // As whole numbers: a link may look like a signalling NaN, which no float operation may touch.
  Int4 low = reinterpret_cast<Int4>(box.lower);
  Int4 high = reinterpret_cast<Int4>(box.upper);
  low[3] = static_cast<std::int32_t>(link.first);
  high[3] = static_cast<std::int32_t>(link.count);
  lower = reinterpret_cast<Float4>(low);
  upper = reinterpret_cast<Float4>(high);
}

SlotTree::SlotTree(const Bvh2& bvh) : references(bvh.references), bounds(bvh.bounds) {
  slots.resize(2 * bvh.nodes.size());
  parent_slot.resize(bvh.nodes.size());
  if (bvh.nodes.empty()) return;
  parent_slot[0] = kNone;
  parallel_for(bvh.nodes.size(), 4096, [&](std::size_t i) {
    for (std::size_t side = 0; side < 2; ++side) {
      const Box box = bvh.nodes[i].child_box(static_cast<int>(side));
      const Bvh2Node::Child link = bvh.nodes[i].child[side];
      slots[2 * i + side].set({to_float4(box.lower), to_float4(box.upper)}, link);
      if (link.count == 0) parent_slot[link.first] = static_cast<std::uint32_t>(2 * i + side);
    }
  });
}

Bvh2 SlotTree::to_bvh2() const {
  Bvh2 bvh;
  bvh.bounds = bounds;
  if (parent_slot.empty()) {
    bvh.references = references;
    return bvh;
  }
  Emitter(*this, bvh).run();
  return bvh;
}

}  // namespace grove
