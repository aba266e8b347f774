#include "grove/build/bottom_up/lbvh.h"

#include <algorithm>
#include <bit>

#include "grove/build/bottom_up/morton_order.h"

namespace grove {
namespace {

// Subtrees are stretches of the Morton order.
class MortonTopology {
 public:
  struct Subtree {
    std::uint32_t first, count;
  };

  explicit MortonTopology(const MortonOrder& order) : order_(order) {}

  [[nodiscard]] Subtree root() const { return {0, static_cast<std::uint32_t>(order_.references.size())}; }
  [[nodiscard]] static std::uint32_t count(const Subtree& subtree) { return subtree.count; }
  [[nodiscard]] const PrimitiveReference& reference(const Subtree& subtree) const { return order_.references[subtree.first]; }

  [[nodiscard]] std::pair<Subtree, Subtree> children(const Subtree& subtree) const {
    const std::uint32_t left = left_count(subtree);
    return {{subtree.first, left}, {subtree.first + left, subtree.count - left}};
  }

 private:
  [[nodiscard]] std::uint32_t left_count(const Subtree& subtree) const {
    const std::uint64_t* const codes = order_.codes.data() + subtree.first;
    const std::uint64_t different = codes[0] ^ codes[subtree.count - 1];
    if (different == 0) return subtree.count / 2;
    // The first code that has the highest differing bit.
    const std::uint64_t bit = std::bit_floor(different);
    const auto lacks_bit = [bit](std::uint64_t code) { return (code & bit) == 0; };
    return static_cast<std::uint32_t>(std::partition_point(codes, codes + subtree.count, lacks_bit) - codes);
  }

  const MortonOrder& order_;
};

}  // namespace

Bvh2 build_lbvh(const ReferenceList& list, const BottomUpSettings& settings) {
  if (list.references.empty()) return {};
  const MortonOrder order = sort_by_morton_code(list);
  return emit_hierarchy(MortonTopology(order), order.references.size(), list.bounds, settings);
}

}  // namespace grove
