#include "grove/build/fast/planned_nodes.h"

#include <algorithm>

#include "grove/base/parallel.h"

namespace grove {
namespace {

// Subtrees of at most so many binary nodes are pieces.
constexpr std::uint32_t kPieceSize = 4096;

struct Root {
  std::uint32_t node;
  std::uint32_t depth;
};

// The end of the nodes below a node and with it: depth-first order ends with the last subtree.
std::uint32_t end_of_subtree(const Bvh2& bvh, std::uint32_t node) {
  for (;;) {
    const Bvh2Node::Child* const child = bvh.nodes[node].child;
    if (child[1].count == 0) {
      node = child[1].first;
    } else if (child[0].count == 0) {
      node = child[0].first;
    } else {
      return node + 1;
    }
  }
}

class Lister {
 public:
  Lister(const Bvh2& bvh, const CollapsePlan& plan) : bvh_(bvh), plan_(plan) {}

  std::vector<PlannedPiece> run() {
    list_top();
    parallel_for(pieces_.size(), 1, [&](std::size_t i) {
      if (!pieces_[i].is_over_pieces) list_piece(roots_[i], pieces_[i]);
    });
    std::uint32_t node = 0;
    std::uint32_t block = 0;
    for (PlannedPiece& piece : pieces_) {
      piece.first_node = node;
      piece.first_block = block;
      node += static_cast<std::uint32_t>(piece.nodes.size());
      block += piece.block_count;
    }
    return std::move(pieces_);
  }

 private:
  // Where the number of what is listed is to be written: a place of a node of a piece.
  struct Pending {
    Root root;
    std::uint32_t parent;
    int place;
  };
  static constexpr std::uint32_t kNoParent = 0xffffffffU;

  // Nodes over much become pieces of their own.
  void list_top() {
    std::vector<Pending> stack{{{plan_.root().node, 0}, kNoParent, 0}};
    while (!stack.empty()) {
      const Pending top = stack.back();
      stack.pop_back();
      const auto number = static_cast<std::uint32_t>(pieces_.size());
      if (top.parent != kNoParent) pieces_[top.parent].nodes[0].first[top.place] = number;
      PlannedPiece& piece = pieces_.emplace_back();
      roots_.push_back(top.root);
      if (end_of_subtree(bvh_, top.root.node) - top.root.node <= kPieceSize) continue;
      piece.is_over_pieces = true;
      add_node(top.root, number, piece, stack);
    }
  }

  void list_piece(const Root& root, PlannedPiece& piece) const {
    // Mostly a node takes the place of four.
    piece.nodes.reserve((end_of_subtree(bvh_, root.node) - root.node) / 3 + 1);
    std::vector<Pending> stack{{root, kNoParent, 0}};
    while (!stack.empty()) {
      const Pending top = stack.back();
      stack.pop_back();
      const auto number = static_cast<std::uint32_t>(piece.nodes.size());
      if (top.parent != kNoParent) piece.nodes[top.parent].first[top.place] = number;
      add_node(top.root, number, piece, stack);
    }
  }

  // Appends the node with its leaves; its other children, the first on top, are left to be listed below the parent `number`.
  void add_node(const Root& root, std::uint32_t number, PlannedPiece& piece, std::vector<Pending>& stack) const {
    PlannedNode& node = piece.nodes.emplace_back();
    CollapsePlan::Child children[CollapsePlan::kMaxArity];
    const int count = plan_.children(root.node, children);
    for (int i = 0; i < CollapsePlan::kMaxArity; ++i) node.slot[i] = i < count ? children[i].slot : PlannedNode::kNoSlot;
    for (int i = count - 1; i >= 0; --i) {
      node.first[i] = children[i].first;
      node.count[i] = static_cast<std::uint8_t>(children[i].count);
      if (children[i].count > 0) {
        ++piece.block_count;
        piece.depth = std::max(piece.depth, root.depth + 1);
      } else {
        stack.push_back({{children[i].node, root.depth + 1}, number, i});
      }
    }
  }

  const Bvh2& bvh_;
  const CollapsePlan& plan_;
  std::vector<PlannedPiece> pieces_;
  std::vector<Root> roots_;
};

}  // namespace

std::vector<PlannedPiece> list_planned_nodes(const Bvh2& bvh, const CollapsePlan& plan) {
  return Lister(bvh, plan).run();
}

}  // namespace grove
