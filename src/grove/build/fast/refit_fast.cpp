#include "grove/build/fast/refit_fast.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "grove/base/parallel.h"
#include "grove/build/fast/block_corners.h"

namespace grove {
namespace {

// Down to this depth children are refitted side by side: 512 subtrees.
constexpr std::uint32_t kTaskDepth = 3;

template <typename Bvh>
class FastRefitter {
  using Node = typename Bvh::Node;
  using Block = typename Bvh::Block;
  using Child = typename Bvh::Child;

 public:
  FastRefitter(Bvh& bvh, const TriangleMesh& mesh, const CostModel& model) : bvh_(bvh), mesh_(mesh), model_(model), measure_(bvh.bounds) {}

  FastRefit run() {
    const Refitted root = refit_node(0, 0);
    bvh_.bounds = root.box;
    const double area = measure_.half_area(root.box);
    // A scene without area is met in all its nodes by every ray that meets it, which no ratio of areas tells: measured the long way.
    return {area > 0.0 ? (root.cost_below + model_.traversal * area) / area : expected_cost(bvh_, model_), root.all_hittable};
  }

 private:
  struct Refitted {
    Box box;
    double cost_below;  ///< of all that hangs below, times area
    bool all_hittable;
    std::uint32_t count;  ///< triangles, of a leaf
  };

  Refitted refit_leaf(Child leaf) const {
    Block& block = bvh_.blocks()[static_cast<std::size_t>(&bvh_.block(leaf) - bvh_.blocks().data())];
    // Where corners are numbers of vertices, they keep theirs.
    if constexpr (std::is_same_v<Block, TriangleBlock>)
      for (int place = 0; place < Block::kWidth; ++place) put_corners(mesh_, block.primitive[place], place, block);
    Refitted result{{}, 0.0, true, block.count()};
    for (std::uint32_t place = 0; place < result.count; ++place) {
      const Box box = mesh_.bounds(block.primitive[place]);
      result.all_hittable = result.all_hittable && !box.is_empty();
      result.box.grow(box);
    }
    return result;
  }

  Refitted refit_node(std::uint32_t number, std::uint32_t depth) const {
    Node& node = bvh_.nodes()[number];
    int children = 0;
    while (children < Node::kWidth && node.has_child(children)) ++children;
    Refitted refitted[Node::kWidth];
    const auto refit_child = [&](std::size_t i) {
      const Child child = node.child[i];
      refitted[i] = child.is_leaf() ? refit_leaf(child) : refit_node(child.node(), depth + 1);
    };
    if (depth < kTaskDepth) {
      parallel_for(static_cast<std::size_t>(children), 1, refit_child);
    } else {
      for (int i = 0; i < children; ++i) refit_child(static_cast<std::size_t>(i));
    }
    Refitted result{{}, 0.0, true, 0};
    EightBoxes boxes;
    for (int i = 0; i < Node::kWidth; ++i) {
      const Box box = i < children ? refitted[i].box : Box{};
      for (int axis = 0; axis < 3; ++axis) {
        boxes.planes[axis][0][i] = box.lower[axis];
        boxes.planes[axis][1][i] = box.upper[axis];
      }
      if (i >= children) continue;
      result.box.grow(box);
      result.all_hittable = result.all_hittable && refitted[i].all_hittable;
    }
    // A box of nothing has no place among others: the whole is built anew.
    if (!result.all_hittable) return result;
    std::uint32_t orders[Node::kWidth];
    for (std::uint32_t octant = 0; octant < Node::kWidth; ++octant) orders[octant] = node.order_for(octant);
    node.set(boxes, children, orders);
    // Rays meet the boxes as the node has them, which compressed are a little larger.
    for (int i = 0; i < children; ++i) {
      const double entered = refitted[i].count > 0 ? model_.intersection * refitted[i].count : model_.traversal;
      result.cost_below += refitted[i].cost_below + entered * measure_.half_area(node.child_box(i));
    }
    return result;
  }

  Bvh& bvh_;
  const TriangleMesh& mesh_;
  const CostModel& model_;
  const AreaMeasure measure_;
};

}  // namespace

template <typename Bvh>
FastRefit refit_fast(Bvh& bvh, const TriangleMesh& mesh, const CostModel& model) {
  if (bvh.empty()) return {};
  return FastRefitter<Bvh>(bvh, mesh, model).run();
}
template FastRefit refit_fast(FastBvh& bvh, const TriangleMesh& mesh, const CostModel& model);
template FastRefit refit_fast(CompressedFastBvh& bvh, const TriangleMesh& mesh, const CostModel& model);

}  // namespace grove
