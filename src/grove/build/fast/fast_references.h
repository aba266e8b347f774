#pragma once

#include <cstdint>
#include <vector>

#include "grove/accel/fast_bvh.h"

namespace grove {

/// A hierarchy of the fast path as those over lists of references show themselves: the triangles of its blocks in one list, leaf by leaf in depth-first
/// order, and leaves by where theirs begin. What quality is measured from. Refers to the hierarchy. O(nodes + references).
template <typename Bvh>
class FastReferences {
 public:
  explicit FastReferences(const Bvh& bvh) : bvh_(bvh) {
    references.reserve(bvh.references);
    bvh.visit([&](const Box& /*box*/, std::uint32_t /*depth*/, std::uint32_t unit, std::uint32_t count) {
      // Those of unused places come last.
      if (count > 0) references.insert(references.end(), primitives(unit), primitives(unit) + count);
    });
  }

  std::vector<std::uint32_t> references;

  /// Calls visit(box, depth, first, count) for each node and leaf in depth-first order; a leaf has references [first, first + count).
  template <typename Visitor>
  void visit(const Visitor& visitor) const {
    std::uint32_t first = 0;
    bvh_.visit([&](const Box& box, std::uint32_t depth, std::uint32_t number, std::uint32_t count) {
      visitor(box, depth, count > 0 ? first : number, count);
      first += count;
    });
  }

 private:
  [[nodiscard]] const std::uint32_t* primitives(std::uint32_t unit) const { return bvh_.block(Bvh::Child::leaf(unit)).primitive; }

  const Bvh& bvh_;
};

}  // namespace grove
