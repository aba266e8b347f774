#include "grove/build/top_down.h"

#include "grove/build/splits/binned.h"
#include "grove/build/splits/object_median.h"
#include "grove/build/splits/spatial_median.h"
#include "grove/build/splits/sweep.h"
#include "grove/build/top_down_driver.h"

namespace grove {

ReferenceRange measure_all(const HugeVector<PrimitiveReference>& references) {
  std::vector<ReferenceRange> chunks((references.size() + kBuildChunkSize - 1) / kBuildChunkSize);
  parallel_chunks(references.size(), kBuildChunkSize, [&](std::size_t id, std::size_t first, std::size_t last) {
    chunks[id] = measure(references.data(), static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last - first));
  });
  ReferenceRange all{0, static_cast<std::uint32_t>(references.size()), static_cast<std::uint32_t>(references.size())};
  for (const ReferenceRange& chunk : chunks) {
    all.bounds.grow(chunk.bounds);
    all.centres.grow(chunk.centres);
  }
  return all;
}

Bvh2 build_top_down(ReferenceList list, const TopDownSettings& settings) {
  const SplitContext context{AreaMeasure(list.bounds).scale(), SubsetTime(settings.cost)};
  const std::size_t size = list.references.size();
  switch (settings.split) {
    case ObjectSplit::sweep:
      return detail::drive_top_down(std::move(list), size, settings, SweepHeuristic(context));
    case ObjectSplit::object_median:
      return detail::drive_top_down(std::move(list), size, settings, ObjectMedianHeuristic(context));
    case ObjectSplit::spatial_median:
      return detail::drive_top_down(std::move(list), size, settings, SpatialMedianHeuristic(context));
    case ObjectSplit::binned:
      break;
  }
  return detail::drive_top_down(std::move(list), size, settings, BinnedHeuristic(context));
}

void close_reference_gaps(Bvh2& bvh) {
  const std::size_t size = bvh.references.size();
  // new_place[i]: how many references lie before place i.
  HugeVector<std::uint32_t> new_place(size);
  std::vector<std::uint32_t> chunk_first((size + kBuildChunkSize - 1) / kBuildChunkSize);
  parallel_chunks(size, kBuildChunkSize, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    std::uint32_t count = 0;
    for (std::size_t i = first; i < last; ++i) {
      new_place[i] = count;
      count += bvh.references[i] != kNoReference ? 1 : 0;
    }
    chunk_first[chunk] = count;
  });
  std::uint32_t total = 0;
  for (std::uint32_t& first : chunk_first) total += std::exchange(first, total);
  HugeVector<std::uint32_t> closed(total);
  parallel_chunks(size, kBuildChunkSize, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      new_place[i] += chunk_first[chunk];
      if (bvh.references[i] != kNoReference) closed[new_place[i]] = bvh.references[i];
    }
  });
  parallel_for(bvh.nodes.size(), 4096, [&](std::size_t i) {
    for (Bvh2Node::Child& child : bvh.nodes[i].child)
      if (child.count > 0) child.first = new_place[child.first];
  });
  bvh.references = std::move(closed);
}

}  // namespace grove
