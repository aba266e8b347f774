#include "grove/build/octree/part_octants.h"

#include <array>
#include <utility>

#include "grove/base/error.h"
#include "grove/base/parallel.h"
#include "grove/build/split.h"

namespace grove {
namespace {

// How many ids go to each octant, and stay; then where the next of each goes.
using Counts = std::array<std::uint64_t, 9>;

}  // namespace

void OctantSets::part(const OctantSource& source, const OctantCut& cut, std::span<const std::uint32_t> ids, OctreeStore store) {
  const std::size_t size = ids.size();
  const std::size_t chunk_size = size > kOctreeParallelSize ? kBuildChunkSize : std::max<std::size_t>(size, 1);
  octants_.resize(size);
  std::vector<Counts> chunks((size + chunk_size - 1) / chunk_size);
  parallel_chunks(size, chunk_size, [&](std::size_t id, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) octants_[i] = static_cast<std::uint8_t>(cut.octants_of(source.references[ids[i]]));
    Counts& counts = chunks[id];
    if (store == OctreeStore::inner) {
      for (std::size_t i = first; i < last; ++i) {
        if ((octants_[i] & (octants_[i] - 1)) != 0) octants_[i] = 0;
        counts[kOwn] += octants_[i] == 0 ? 1 : 0;
      }
    } else {
      source.overlap.narrow(cut, ids.subspan(first, last - first), octants_.data() + first);
    }
    for (std::size_t i = first; i < last; ++i)
      for (std::uint32_t octant = 0; octant < 8; ++octant) counts[octant] += octants_[i] >> octant & 1U;
  });

  Counts total{};
  for (const Counts& counts : chunks)
    for (std::size_t set = 0; set < total.size(); ++set) total[set] += counts[set];
  total_ = 0;
  for (std::uint32_t octant = 0; octant < 8; ++octant) total_ += total[octant];
  if (total_ + total[kOwn] > 0xfffffffeU)
    throw InputError("an octree would have more than 2^32 - 2 references; split the geometry into instances");
  std::uint64_t next = 0;
  for (std::uint32_t set = 0; set <= kOwn; ++set) {
    first_[set] = static_cast<std::uint32_t>(next);
    for (Counts& counts : chunks) next += std::exchange(counts[set], next);
  }
  first_[kOwn + 1] = static_cast<std::uint32_t>(next);
  ids_.resize(next);
  parallel_chunks(size, chunk_size, [&](std::size_t id, std::size_t first, std::size_t last) {
    Counts cursor = chunks[id];
    for (std::size_t i = first; i < last; ++i) {
      if (octants_[i] == 0) ids_[cursor[kOwn]++] = ids[i];
      for (std::uint32_t left = octants_[i]; left != 0; left &= left - 1)
        ids_[cursor[static_cast<std::size_t>(std::countr_zero(left))]++] = ids[i];
    }
  });
}

}  // namespace grove
