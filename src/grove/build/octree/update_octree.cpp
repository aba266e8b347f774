#include "grove/build/octree/update_octree.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "grove/build/octree/octree_input.h"
#include "grove/build/octree/octree_merger.h"
#include "grove/build/octree/pack_octree.h"

namespace grove {
namespace {

bool still_fits(const Box& cell, const Box& bounds) {
  const float side = bounds.extent()[bounds.longest_axis()];
  const float most = cell.extent()[cell.longest_axis()];
  return cell.contains(bounds) && most <= 2.0F * side;
}

}  // namespace

std::optional<Octree> update_octree(const Octree& tree, ReferenceList list, const OverlapTest& overlap, const OctreeSettings& settings,
                                    std::span<const std::uint32_t> changed) {
  if (list.references.empty() || tree.nodes.empty()) return std::nullopt;
  const OctreeInput input(std::move(list), overlap, settings);
  if (!still_fits(tree.cell, input.bounds)) return std::nullopt;

  // Marked for all ids that the tree or the list may name.
  const auto last = std::max_element(tree.references.begin(), tree.references.end());
  std::vector<bool> is_changed(std::max<std::size_t>(input.references.size(), std::size_t{*last} + 1), false);
  for (const std::uint32_t id : changed)
    if (id < is_changed.size()) is_changed[id] = true;
  std::vector<std::uint32_t> added;
  for (const std::uint32_t id : input.ids)
    if (is_changed[id]) added.push_back(id);

  const ChangedOctree before(tree, is_changed, settings.largest_leaf());
  std::vector<OctreeItem> items;
  if (tree.nodes[0].cut_axes == 0) {
    // Never cut: a leaf.
    std::vector<std::uint32_t> left;
    before.append_leaf(0, left);
    if (!left.empty()) items.push_back(OctreeItem::set(left, before.is_leaf_kept(0)));
  } else if (before.reference_count(0) > 0) {
    items.push_back(OctreeItem::subtree(before, 0));
  }
  if (!added.empty()) items.push_back(OctreeItem::set(added));
  std::uint64_t references = 0;
  for (const OctreeItem& item : items) references += item.count();
  if (references > input.capacity) return std::nullopt;
  const OctreeDraft after =
      with_octree_builder(input, settings, [&](const auto& builder) { return OctreeMerger(builder).merge(items, input.root(tree.cell)); });
  return pack_octree(after, input.bounds, tree.cell, &tree);
}

}  // namespace grove
