#include "grove/build/octree/build_octree.h"

#include <cmath>
#include <numeric>

#include "grove/build/octree/middle_planes.h"
#include "grove/build/octree/octree_builder.h"
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

}  // namespace

Octree build_octree(const ReferenceList& list, const OverlapTest& overlap, const OctreeSettings& settings) {
  if (list.references.empty()) return {};
  const std::size_t size = list.references.size();
  const OctantSource source{list.references, overlap};
  // Planes that go by costs part the box of the scene as it is.
  const bool is_octree_r = settings.split == OctreeSplit::octree_r;
  const Box cell = is_octree_r ? list.bounds : cube_around(list.bounds);
  const detail::OctreeCell root{
      {to_float4(cell.lower), to_float4(cell.upper)}, 0, static_cast<std::uint64_t>(settings.most_references * static_cast<double>(size))};
  Places places(size);
  std::iota(places.begin(), places.end(), 0U);
  const auto drive = [&](const auto& planes) {
    const detail::OctreeBuilder builder(planes, source, settings, most_depth(settings, size));
    return pack_octree(builder.build(places, root), list.bounds, cell);
  };
  if (is_octree_r) return drive(OctreeRPlanes(settings.search, settings.candidate_count));
  return drive(MiddlePlanes());
}

}  // namespace grove
