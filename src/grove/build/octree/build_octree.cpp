#include "grove/build/octree/build_octree.h"

#include <cmath>
#include <utility>

#include "grove/build/octree/middle_planes.h"
#include "grove/build/octree/octree_builder.h"
#include "grove/build/octree/octree_merger.h"
#include "grove/build/octree/octree_r_planes.h"
#include "grove/build/octree/pack_octree.h"

namespace grove {
namespace {

std::uint32_t most_depth(const OctreeSettings& settings, std::size_t size) {
  const auto automatic = static_cast<std::uint32_t>(std::ceil((8.0 + 1.3 * std::log2(static_cast<double>(size))) / 3.0));
  return std::min(settings.most_depth > 0 ? settings.most_depth : automatic, Octree::kMaxDepth);
}

// The smallest cube around a box that has its lower corner. Where rounding would leave something outside, its side grows.
Box cube_around(const Box& box) {
  float side = box.extent()[box.longest_axis()];
  Box cube;
  do {
    cube = {box.lower, box.lower + Vec3(side)};
    side = std::nextafter(side, std::numeric_limits<float>::infinity());
  } while (!cube.contains(box));
  return cube;
}

// With primitive i at place i: there are gaps where primitives can never be hit.
HugeVector<PrimitiveReference> indexed_by_primitive(HugeVector<PrimitiveReference> references) {
  const std::size_t size = std::size_t{references.back().primitive()} + 1;
  if (size == references.size()) return references;
  HugeVector<PrimitiveReference> indexed(size, make_reference(Box(), 0));
  for (const PrimitiveReference& reference : references) indexed[reference.primitive()] = reference;
  return indexed;
}

// Subsets, in order of id; at least two where there is anything to merge.
OctreeDraft build_from_subsets(const OctreeBuilder<MiddlePlanes>& builder, std::span<const std::uint32_t> ids, const OctreeCell& root) {
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
  return OctreeMerger<MiddlePlanes>(builder).merge(items, root);
}

}  // namespace

Octree build_octree(ReferenceList list, const OverlapTest& overlap, const OctreeSettings& settings) {
  if (list.references.empty()) return {};
  const std::size_t size = list.references.size();
  HugeVector<std::uint32_t> ids(size);
  for (std::size_t i = 0; i < size; ++i) ids[i] = list.references[i].primitive();
  const HugeVector<PrimitiveReference> references = indexed_by_primitive(std::move(list.references));
  const OctantSource source{references, overlap};
  // Planes that go by costs part the box of the scene as it is.
  const bool is_octree_r = settings.split == OctreeSplit::octree_r;
  const Box cell = is_octree_r ? list.bounds : cube_around(list.bounds);
  const OctreeCell root{
      {to_float4(cell.lower), to_float4(cell.upper)}, 0, static_cast<std::uint64_t>(settings.most_references * static_cast<double>(size))};
  const std::uint32_t depth = most_depth(settings, size);
  OctreeDraft draft;
  if (is_octree_r) {
    const OctreeRPlanes planes(settings.search, settings.candidate_count);
    draft = OctreeBuilder(planes, source, settings, depth).build(ids, root);
  } else {
    const MiddlePlanes planes;
    const OctreeBuilder builder(planes, source, settings, depth);
    draft = settings.build == OctreeBuild::merge ? build_from_subsets(builder, ids, root) : builder.build(ids, root);
  }
  return pack_octree(draft, list.bounds, cell);
}

}  // namespace grove
