#include "grove/build/octree/build_octree.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "grove/build/octree/octree_input.h"
#include "grove/build/octree/octree_merger.h"
#include "grove/build/octree/pack_octree.h"

namespace grove {
namespace {

// Subsets, in order of id; at least two where there is anything to merge.
template <OctreePlanes P>
OctreeDraft build_from_subsets(const OctreeBuilder<P>& builder, std::span<const std::uint32_t> ids, const OctreeCell& root) {
  constexpr std::size_t kFewest = 2;
  constexpr std::size_t kMost = 8;
  constexpr std::size_t kWanted = 65536;
  const std::size_t count = std::clamp(ids.size() / kWanted, kFewest, kMost);
  const std::size_t chunk = (ids.size() + count - 1) / count;
  std::vector<OctreeDraft> drafts(count);
  parallel_chunks(ids.size(), chunk, [&](std::size_t i, std::size_t first, std::size_t last) {
    OctreeCell cell = root;
    cell.capacity = static_cast<std::uint64_t>(builder.settings().most_references * static_cast<double>(last - first));
    drafts[i] = builder.build(ids.subspan(first, last - first), cell);
  });
  std::vector<OctreeItem> items;
  for (const OctreeDraft& draft : drafts)
    if (draft.root.kind() != DraftSlot::Kind::empty) items.push_back(OctreeItem::subtree(draft.resolve(draft.root)));
  return OctreeMerger<P>(builder).merge(items, root);
}

}  // namespace

Octree build_octree(ReferenceList list, const OverlapTest& overlap, const OctreeSettings& settings) {
  if (list.references.empty()) return {};
  const OctreeInput input(std::move(list), overlap, settings);
  const bool is_merged = settings.build == OctreeBuild::merge && settings.split == OctreeSplit::median;
  const OctreeDraft draft = with_octree_builder(input, settings, [&](const auto& builder) {
    const OctreeCell root = input.root(input.cell);
    return is_merged ? build_from_subsets(builder, input.ids, root) : builder.build(input.ids, root);
  });
  return pack_octree(draft, input.bounds, input.cell);
}

}  // namespace grove
