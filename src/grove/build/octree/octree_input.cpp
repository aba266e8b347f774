#include "grove/build/octree/octree_input.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace grove {
namespace {

std::uint32_t depth_limit(const OctreeSettings& settings, std::size_t size) {
  const auto automatic = static_cast<std::uint32_t>(std::ceil((8.0 + 1.3 * std::log2(static_cast<double>(size))) / 3.0));
  return std::min(settings.most_depth > 0 ? settings.most_depth : automatic, Octree::kMaxDepth);
}

// Room on each side of the bounds, as a part of their extent, so that primitives can move a little beyond without a new tree (update_octree.h).
constexpr float kMargin = 1.0F / 64.0F;

// A cube around a box with that margin, which has the box in its lower corner. Where rounding would leave something outside, its side grows.
Box cube_around(const Box& box) {
  const float longest = box.extent()[box.longest_axis()];
  const Vec3 lower = box.lower - Vec3(kMargin * longest);
  float side = longest + 2.0F * kMargin * longest;
  Box cube;
  do {
    cube = {lower, lower + Vec3(side)};
    side = std::nextafter(side, std::numeric_limits<float>::infinity());
  } while (!cube.contains(box));
  return cube;
}

// The box with the margin; flat ones stay flat.
Box box_around(const Box& box) {
  const Vec3 margin = kMargin * box.extent();
  return {box.lower - margin, box.upper + margin};
}

HugeVector<std::uint32_t> ids_of(const HugeVector<PrimitiveReference>& references) {
  HugeVector<std::uint32_t> ids(references.size());
  for (std::size_t i = 0; i < references.size(); ++i) ids[i] = references[i].primitive();
  return ids;
}

// With primitive i at place i: there are gaps where primitives can never be hit.
HugeVector<PrimitiveReference> indexed_by_primitive(HugeVector<PrimitiveReference> references) {
  const std::size_t size = std::size_t{references.back().primitive()} + 1;
  if (size == references.size()) return references;
  HugeVector<PrimitiveReference> indexed(size, make_reference(Box(), 0));
  for (const PrimitiveReference& reference : references) indexed[reference.primitive()] = reference;
  return indexed;
}

}  // namespace

OctreeInput::OctreeInput(ReferenceList list, const OverlapTest& overlap_test, const OctreeSettings& settings)
    : bounds(list.bounds),
      cell(settings.split == OctreeSplit::octree_r ? box_around(bounds) : cube_around(bounds)),
      ids(ids_of(list.references)),
      references(indexed_by_primitive(std::move(list.references))),
      source{references, overlap_test},
      most_depth(depth_limit(settings, ids.size())),
      capacity(static_cast<std::uint64_t>(settings.most_references * static_cast<double>(ids.size()))) {}

}  // namespace grove
