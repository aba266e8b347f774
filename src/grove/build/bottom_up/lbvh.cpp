#include "grove/build/bottom_up/lbvh.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "grove/base/parallel.h"
#include "grove/build/bottom_up/morton_order.h"
#include "grove/build/bottom_up/subtree_cost.h"
#include "grove/build/hierarchy_part.h"

namespace grove {
namespace {

// Builds the subtree over a stretch of the order in one task, from the references upwards in one sweep, as a Cartesian tree of the codes' differences
// is built: two neighbours are joined as soon as both are known to be whole. The sweep goes from the last reference to the first and puts each
// node before the last one, so that they end up in depth-first order.
class Sweep {
 public:
  Sweep(const ReferenceList& list, const MortonOrder& order, const SubtreeCost& subtree_cost, std::uint32_t* ids)
      : references_(list.references.data()),
        indices_(order.indices.data()),
        codes_(order.codes.data()),
        subtree_cost_(subtree_cost),
        ids_(ids) {}

  HierarchyPart build(std::uint32_t first, std::uint32_t count, Box4& bounds) {
    nodes_.resize(count);
    next_ = count;
    // Subtrees that wait for what stands before them, the first last, each with how it differs from the one after it. Going up the stack the highest
    // bit of that falls.
    struct Waiting {
      Subtree subtree;
      std::uint64_t difference;
    };
    Waiting waiting[66];
    int waiting_count = 0;
    std::uint64_t difference_after = std::numeric_limits<std::uint64_t>::max();
    for (std::uint32_t end = first + count; end > first;) {
      // References are fetched where they stand, as each is needed once; neighbours in the order lie anywhere in memory.
      __builtin_prefetch(references_ + indices_[end - 1 > first + kAhead ? end - 1 - kAhead : first]);
      const std::uint32_t begin = start_of_equal_codes(first, end);
      Subtree subtree = build_equal(begin, end - begin);
      const std::uint64_t difference = begin > first ? codes_[begin] ^ codes_[begin - 1] : std::numeric_limits<std::uint64_t>::max();
      while (difference_after < difference) {
        --waiting_count;
        subtree = join(subtree, waiting[waiting_count].subtree);
        difference_after = waiting[waiting_count].difference;
      }
      waiting[waiting_count++] = {subtree, difference_after};
      difference_after = difference;
      end = begin;
    }
    return take(waiting[0].subtree, bounds);
  }

 private:
  struct Subtree {
    Box4 box;
    Bvh2Node::Child link;
    float cost;
    std::uint32_t first;
    std::uint32_t count;
    std::uint32_t height;
    std::uint32_t nodes_end;  // its nodes are those put since next_ was this
  };

  [[nodiscard]] std::uint32_t start_of_equal_codes(std::uint32_t first, std::uint32_t end) const {
    std::uint32_t begin = end - 1;
    while (begin > first && codes_[begin - 1] == codes_[begin]) --begin;
    return begin;
  }

  Subtree build_equal(std::uint32_t first, std::uint32_t count) {
    if (count == 1) {
      const PrimitiveReference& reference = references_[indices_[first]];
      ids_[first] = reference.primitive();
      const Box4 box = reference.box();
      return {box, {first, 1}, subtree_cost_.of_reference(box), first, 1, 0, next_};
    }
    const std::uint32_t left_count = count / 2;
    const Subtree right = build_equal(first + left_count, count - left_count);
    return join(build_equal(first, left_count), right);
  }

  Subtree join(const Subtree& left, const Subtree& right) {
    Subtree both{left.box, {}, 0.0F, left.first, left.count + right.count, 0, right.nodes_end};
    both.box.grow(right.box);
    const SubtreeCost::Decision decision = subtree_cost_.of_pair(both.box, both.count, left.cost + right.cost);
    both.cost = decision.cost;
    if (decision.is_leaf) {
      both.link = {both.first, both.count};
      next_ = both.nodes_end;
      return both;
    }
    Bvh2Node& node = nodes_[--next_];
    set_children(node, left.box, right.box);
    node.child[0] = left.link;
    node.child[1] = right.link;
    both.link = {next_, 0};
    both.height = 1 + std::max(left.height, right.height);
    return both;
  }

  HierarchyPart take(const Subtree& whole, Box4& bounds) {
    bounds = whole.box;
    HierarchyPart part;
    part.depth = whole.height;
    if (whole.link.count > 0) {
      part.link = whole.link;
      return part;
    }
    part.nodes.assign(nodes_.begin() + next_, nodes_.end());
    for (Bvh2Node& node : part.nodes)
      for (Bvh2Node::Child& child : node.child)
        if (child.count == 0) child.first -= next_;
    return part;
  }

  static constexpr std::uint32_t kAhead = 16;

  const PrimitiveReference* references_;
  const std::uint32_t* indices_;
  const std::uint64_t* codes_;
  const SubtreeCost& subtree_cost_;
  std::uint32_t* ids_;
  HugeVector<Bvh2Node> nodes_;
  std::uint32_t next_ = 0;
};

class LinearBuilder {
 public:
  LinearBuilder(const ReferenceList& list, const MortonOrder& order, const SubtreeCost& subtree_cost, std::uint32_t* ids)
      : list_(list), order_(order), subtree_cost_(subtree_cost), ids_(ids) {}

  HierarchyPart build(std::uint32_t first, std::uint32_t count, Box4& bounds) const {
    if (count <= kTaskSize) return Sweep(list_, order_, subtree_cost_, ids_).build(first, count, bounds);
    const std::uint32_t left = left_count(first, count);
    HierarchyPart part;
    parallel_invoke([&] { part.children[0] = std::make_unique<HierarchyPart>(build(first, left, part.bounds[0])); },
                    [&] { part.children[1] = std::make_unique<HierarchyPart>(build(first + left, count - left, part.bounds[1])); });
    part.depth = 1 + std::max(part.children[0]->depth, part.children[1]->depth);
    bounds = part.bounds[0];
    bounds.grow(part.bounds[1]);
    return part;
  }

 private:
  static constexpr std::uint32_t kTaskSize = 8192;

  // How many lack the highest bit in which the codes differ; half where they are equal.
  [[nodiscard]] std::uint32_t left_count(std::uint32_t first, std::uint32_t count) const {
    const std::uint64_t* const codes = order_.codes.data() + first;
    const std::uint64_t different = codes[0] ^ codes[count - 1];
    if (different == 0) return count / 2;
    const std::uint64_t bit = std::bit_floor(different);
    const auto lacks_bit = [bit](std::uint64_t code) { return (code & bit) == 0; };
    return static_cast<std::uint32_t>(std::partition_point(codes, codes + count, lacks_bit) - codes);
  }

  const ReferenceList& list_;
  const MortonOrder& order_;
  const SubtreeCost& subtree_cost_;
  std::uint32_t* ids_;
};

}  // namespace

Bvh2 build_lbvh(const ReferenceList& list, const BottomUpSettings& settings) {
  if (list.references.empty()) return {};
  const MortonOrder order = sort_by_morton_code(list);
  Bvh2 bvh;
  bvh.bounds = list.bounds;
  bvh.references.resize(list.references.size());
  const SubtreeCost subtree_cost(settings, AreaMeasure(list.bounds).scale());
  Box4 unused;
  HierarchyPart root =
      LinearBuilder(list, order, subtree_cost, bvh.references.data()).build(0, static_cast<std::uint32_t>(list.references.size()), unused);
  assemble(root, bvh);
  return bvh;
}

}  // namespace grove
