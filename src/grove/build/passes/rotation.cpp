#include "grove/build/passes/rotation.h"

#include <algorithm>
#include <utility>

#include "grove/build/hierarchy_part.h"
#include "grove/build/passes/refit.h"

namespace grove {
namespace {

// What stands in one place of a node: a leaf or another node.
struct Side {
  Bvh2Node::Child link;
  Box4 box;
  double cost;  // times area
  std::uint32_t height;
};

class Rotator {
 public:
  Rotator(Bvh2& bvh, const CostModel& cost, std::span<std::uint8_t> changed)
      : bvh_(bvh), cost_(cost), changed_(changed), scale_(AreaMeasure(bvh.bounds).scale()) {}

  struct Node {
    Side sides[2];
    std::uint64_t rotations = 0;
  };

  Node rotate(std::uint32_t number, std::uint32_t depth) {
    Bvh2Node& node = bvh_.nodes[number];
    Node result;
    Node below[2];
    const auto descend = [&](int i) {
      const Bvh2Node::Child link = node.child[i];
      const Box box = node.child_box(i);
      const Box4 box4{to_float4(box.lower), to_float4(box.upper)};
      if (link.count > 0) {
        result.sides[i] = {link, box4, cost_.intersection * link.count * area(box4), 0};
        return;
      }
      below[i] = rotate(link.first, depth + 1);
      result.sides[i] = join(link, box4, below[i]);
    };
    if (depth < kUpdateTaskDepth) {
      parallel_invoke([&] { descend(0); }, [&] { descend(1); });
    } else {
      descend(0);
      descend(1);
    }
    result.rotations = below[0].rotations + below[1].rotations + exchange(node, result.sides, below, depth);
    return result;
  }

  [[nodiscard]] double area(const Box4& box) const { return static_cast<double>(scaled_half_area(box, scale_)); }

  // Cost times area of a node with these sides.
  [[nodiscard]] double cost(const Box4& box, const Node& node) const {
    return cost_.traversal * area(box) + node.sides[0].cost + node.sides[1].cost;
  }

 private:
  // Two places that change contents: of the node itself (level 0), or of its child on that side (level 1).
  struct Exchange {
    int grandchild[2] = {-1, -1};  // on each side: which grandchild, or -1 for the child itself
  };

  [[nodiscard]] Side join(Bvh2Node::Child link, const Box4& box, const Node& node) const {
    return {link, box, cost(box, node), 1 + std::max(node.sides[0].height, node.sides[1].height)};
  }

  // Makes the best exchange across the two sides of a node. Returns whether there was one.
  std::uint64_t exchange(Bvh2Node& node, Side* sides, Node* below, std::uint32_t depth) {
    Exchange best;
    double most_saved = 0.0;
    for (int a = -1; a < 2; ++a) {
      if (a >= 0 && sides[0].link.count > 0) break;
      for (int b = -1; b < 2; ++b) {
        if (b >= 0 && sides[1].link.count > 0) break;
        if (a < 0 && b < 0) continue;
        const Exchange candidate{{a, b}};
        if (!fits(candidate, sides, below, depth)) continue;
        double saved = 0.0;
        for (int s = 0; s < 2; ++s)
          if (candidate.grandchild[s] >= 0) saved += area(sides[s].box) - area(box_after(candidate, s, sides, below));
        // More than rounding, so that two equal places do not change back and forth.
        if (saved > most_saved && saved > 1e-6 * (area(sides[0].box) + area(sides[1].box))) {
          most_saved = saved;
          best = candidate;
        }
      }
    }
    if (!(most_saved > 0.0)) return 0;
    Side& x = place(best, 0, sides, below);
    Side& y = place(best, 1, sides, below);
    std::swap(x, y);
    for (int s = 0; s < 2; ++s) {
      if (best.grandchild[s] < 0) continue;
      // What is left of the child on this side has new contents.
      const std::uint32_t number = sides[s].link.first;
      Bvh2Node& child = bvh_.nodes[number];
      write(child, below[s].sides);
      if (!changed_.empty()) changed_[number] = 1;
      Box4 box = below[s].sides[0].box;
      box.grow(below[s].sides[1].box);
      sides[s] = join(sides[s].link, box, below[s]);
    }
    write(node, sides);
    return 1;
  }

  static Side& place(const Exchange& exchange, int side, Side* sides, Node* below) {
    return exchange.grandchild[side] < 0 ? sides[side] : below[side].sides[exchange.grandchild[side]];
  }

  // The box of the child on side `s` when its grandchild has been exchanged.
  static Box4 box_after(const Exchange& exchange, int s, Side* sides, Node* below) {
    Box4 box = below[s].sides[1 - exchange.grandchild[s]].box;
    box.grow(place(exchange, 1 - s, sides, below).box);
    return box;
  }

  static bool fits(const Exchange& exchange, Side* sides, Node* below, std::uint32_t depth) {
    for (int s = 0; s < 2; ++s) {
      if (exchange.grandchild[s] < 0) continue;
      const std::uint32_t height = std::max(below[s].sides[1 - exchange.grandchild[s]].height, place(exchange, 1 - s, sides, below).height);
      if (depth + 2 + height > Bvh2::kMaxDepth) return false;
    }
    return true;
  }

  static void write(Bvh2Node& node, const Side* sides) {
    set_children(node, sides[0].box, sides[1].box);
    node.child[0] = sides[0].link;
    node.child[1] = sides[1].link;
  }

  Bvh2& bvh_;
  const CostModel& cost_;
  std::span<std::uint8_t> changed_;
  float scale_;
};

}  // namespace

Rotated rotate(Bvh2& bvh, const CostModel& cost, std::span<std::uint8_t> changed) {
  if (bvh.nodes.empty()) return {expected_cost(bvh, cost), 0};
  Rotator rotator(bvh, cost, changed);
  const Rotator::Node root = rotator.rotate(0, 0);
  bvh.depth = 1 + std::max(root.sides[0].height, root.sides[1].height);
  const Box4 box{to_float4(bvh.bounds.lower), to_float4(bvh.bounds.upper)};
  const double area = rotator.area(box);
  return {area > 0.0 ? rotator.cost(box, root) / area : expected_cost(bvh, cost), root.rotations};
}

}  // namespace grove
