#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "grove/base/huge_vector.h"
#include "grove/build/octree/octant_test.h"
#include "grove/build/octree/octree_settings.h"

namespace grove {

/// From here on a set is worth several tasks.
inline constexpr std::size_t kOctreeParallelSize = 65536;

/// Primitive ids, ascending: what the sets of an octree's builder are made of.
using Ids = HugeVector<std::uint32_t>;

/// What all sets of one build share. Primitive i is references[i]; those that can never be hit are in no set.
struct OctantSource {
  std::span<const PrimitiveReference> references;
  const OverlapTest& overlap;
};

/// A set parted by a cut: one set for each octant, and what stays with the node.
class OctantSets {
 public:
  /// With OctreeStore::leaf, each id goes to every octant that its primitive overlaps and none stays; with OctreeStore::inner it goes to the octant that
  /// has its box whole, or stays. In parallel for large sets; the same for any number of threads. O(n).
  void part(const OctantSource& source, const OctantCut& cut, std::span<const std::uint32_t> ids, OctreeStore store);

  [[nodiscard]] std::uint32_t count(std::uint32_t octant) const { return first_[octant + 1] - first_[octant]; }
  [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t octant) const { return {ids_.data() + first_[octant], count(octant)}; }
  [[nodiscard]] std::span<const std::uint32_t> own() const { return of(kOwn); }
  /// Over all octants, without what stays.
  [[nodiscard]] std::uint64_t total() const { return total_; }

 private:
  static constexpr std::uint32_t kOwn = 8;

  Ids ids_;
  HugeVector<std::uint8_t> octants_;  // of each id of the set
  std::uint32_t first_[10] = {};
  std::uint64_t total_ = 0;
};

}  // namespace grove
