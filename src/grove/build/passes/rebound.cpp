#include "grove/build/passes/rebound.h"

#include <algorithm>
#include <vector>

#include "grove/base/parallel.h"
#include "grove/build/passes/leaf_writer.h"
#include "grove/build/volumes/fit_volume.h"

namespace grove {
namespace {

// Subtrees of fewer nodes are done by one task.
constexpr std::uint32_t kTaskSize = 512;

// Fits a volume to each slot of a binary hierarchy, and to the root.
template <BoundingVolume V>
class SlotVolumes {
 public:
  SlotVolumes(const Bvh2& bvh, const HullList& hulls, const UnitSpace& space) : bvh_(bvh), hulls_(hulls), space_(space) {
    volumes_.resize(2 * bvh.nodes.size() + 1);
    const Bvh2Node::Child root{0, bvh.nodes.empty() ? static_cast<std::uint32_t>(bvh.references.size()) : 0};
    fit(root_place(), root, bvh.bounds, static_cast<std::uint32_t>(bvh.nodes.size()));
  }

  [[nodiscard]] const V& operator[](std::uint32_t slot) const { return volumes_[slot == CollapsePlan::kRootSlot ? root_place() : slot]; }

  [[nodiscard]] SlotAreas areas() const {
    SlotAreas areas;
    areas.slots.resize(root_place());
    parallel_for(areas.slots.size(), 16384, [&](std::size_t i) { areas.slots[i] = volumes_[i].half_area(); });
    areas.root = volumes_[root_place()].half_area();
    return areas;
  }

 private:
  // What a parent needs to know of a subtree.
  struct Subtree {
    ExtremalPoints extremal;
    std::uint32_t first, count;  // references
  };

  [[nodiscard]] std::size_t root_place() const { return volumes_.size() - 1; }

  // Fits the volumes of a whole subtree, of which `link` is the root and whose nodes end before `last`.
  Subtree fit(std::size_t place, const Bvh2Node::Child& link, const Box& box, std::uint32_t last) {
    Subtree subtree = link.count > 0 ? leaf(link) : fit_children(link.first, last);
    const HullRange range(hulls_, space_, subtree.first, subtree.count);
    volumes_[place] = fit_volume<V>({subtree.extremal, range, space_.to_unit(box)});
    return subtree;
  }

  [[nodiscard]] Subtree leaf(const Bvh2Node::Child& link) const {
    return {ExtremalPoints(HullRange(hulls_, space_, link.first, link.count)), link.first, link.count};
  }

  Subtree fit_children(std::uint32_t number, std::uint32_t last) {
    const Bvh2Node& node = bvh_.nodes[number];
    const std::uint32_t middle = node.child[1].count > 0 ? last : node.child[1].first;
    Subtree right;
    Subtree left;
    const auto fit_left = [&] { left = fit(2 * std::size_t{number}, node.child[0], node.child_box(0), middle); };
    const auto fit_right = [&] { right = fit(2 * std::size_t{number} + 1, node.child[1], node.child_box(1), last); };
    if (last - number < kTaskSize) {
      fit_left();
      fit_right();
    } else {
      parallel_invoke(fit_left, fit_right);
    }
    left.extremal.grow(right.extremal);
    left.count += right.count;
    return left;
  }

  const Bvh2& bvh_;
  const HullList& hulls_;
  const UnitSpace& space_;
  HugeVector<V> volumes_;  // the root's last
};

// Emits the planned hierarchy in depth-first order of the nodes that are opened.
template <BoundingVolume V>
void emit(const Bvh2& bvh, const CollapsePlan& plan, const SlotVolumes<V>& volumes, VolumeBvh<V>& output) {
  LeafWriter leaves(bvh.references, output.references);
  struct Pending {
    CollapsePlan::Child child;
    std::uint32_t number;
    std::uint32_t depth;
  };
  output.nodes.resize(1);
  std::vector<Pending> stack{{plan.root(), 0, 0}};
  while (!stack.empty()) {
    const Pending top = stack.back();
    stack.pop_back();
    output.depth = std::max(output.depth, top.depth);
    const V& volume = volumes[top.child.slot];
    if (top.child.count > 0) {
      const auto [first, count] = leaves.write(top.child.first, top.child.count);
      output.nodes[top.number] = {volume, first, count, 1};
      continue;
    }
    CollapsePlan::Child children[CollapsePlan::kMaxArity];
    const auto count = static_cast<std::uint32_t>(plan.children(top.child.node, children));
    const auto first = static_cast<std::uint32_t>(output.nodes.size());
    output.nodes[top.number] = {volume, first, count, 0};
    output.nodes.resize(first + std::size_t{count});
    for (std::uint32_t i = count; i-- > 0;) stack.push_back({children[i], first + i, top.depth + 1});
  }
}

}  // namespace

template <BoundingVolume V>
VolumeBvh<V> rebound(const Bvh2& bvh, const HullList& hulls, const CollapseSettings& settings) {
  VolumeBvh<V> output;
  if (bvh.references.empty()) return output;
  output.bounds = bvh.bounds;
  output.space = UnitSpace(bvh.bounds);
  const SlotVolumes<V> volumes(bvh, hulls, output.space);
  const SlotAreas areas = volumes.areas();
  const CollapsePlan plan(bvh, areas.slots, areas.root, settings);
  emit(bvh, plan, volumes, output);
  return output;
}

template VolumeBvh<OrientedBox> rebound(const Bvh2& bvh, const HullList& hulls, const CollapseSettings& settings);
template VolumeBvh<BoundingSphere> rebound(const Bvh2& bvh, const HullList& hulls, const CollapseSettings& settings);

}  // namespace grove
