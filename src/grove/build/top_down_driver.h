#pragma once

// The top-down driver of binary hierarchies: it owns recursion, tasks, depth and memory; which way a range is parted is a heuristic's.
//
// Large ranges are searched and partitioned in parallel in chunks of fixed size, moving between two buffers; smaller ones become tasks;
// from kTaskSize on a task builds the subtree in place. So the result is the same, bit for bit, for any number of threads.

#include <algorithm>
#include <cstring>
#include <utility>

#include "grove/base/parallel.h"
#include "grove/build/hierarchy_part.h"
#include "grove/build/split.h"
#include "grove/build/top_down.h"

namespace grove::detail {

// Ranges below this are built by one task.
inline constexpr std::uint32_t kTaskSize = 8192;
// Ranges above this are searched and partitioned by several tasks.
inline constexpr std::uint32_t kParallelSize = 131072;
// So near to the greatest depth ranges are halved: 2^32 references take 32 more levels.
inline constexpr std::uint32_t kHalvedLevels = 32;

// What is decided for a range before anything moves.
enum class Decision : std::uint8_t { leaf, split, halve };

inline Decision decide(const ReferenceRange& range, const Split& split, std::uint32_t depth, const TopDownSettings& settings,
                       float area_scale) {
  const bool may_be_leaf = range.count <= settings.leaf_size;
  if (!split.is_possible || depth + kHalvedLevels >= settings.most_depth) return may_be_leaf ? Decision::leaf : Decision::halve;
  if (!may_be_leaf) return Decision::split;
  const auto area = static_cast<double>(scaled_half_area(range.bounds, area_scale));
  const double leaf_cost = settings.cost.intersection * settings.cost.in_whole_blocks(range.count) * area;
  // Equation 2 charges each subset its own steps and the set none.
  const double step = settings.cost.split_cost == SplitCost::equation_2 ? 0.0 : settings.cost.traversal * area;
  return leaf_cost <= step + static_cast<double>(split.cost) ? Decision::leaf : Decision::split;
}

// Gives each side its stretch of the buffer; what is left over for dividing references is shared in proportion.
inline void place_sides(const ReferenceRange& range, const Split& split, ReferenceRange& left, ReferenceRange& right) {
  const std::uint64_t total = std::uint64_t{split.left_count} + split.right_count;
  const std::uint64_t slack = range.capacity - total;
  left.bounds = split.left;
  right.bounds = split.right;
  left.first = range.first;
  left.count = split.left_count;
  left.capacity = split.left_count + static_cast<std::uint32_t>(slack * split.left_count / total);
  right.first = range.first + left.capacity;
  right.count = split.right_count;
  right.capacity = range.capacity - left.capacity;
}

inline void halve(const PrimitiveReference* references, const ReferenceRange& range, ReferenceRange& left, ReferenceRange& right) {
  left = measure(references, range.first, range.count / 2);
  right = measure(references, range.first + left.count, range.count - left.count);
  right.capacity = range.capacity - left.count;
}

// Builds the subtree of a small range in place, in one task.
template <SplitHeuristic H>
class SubtreeBuilder {
 public:
  SubtreeBuilder(PrimitiveReference* references, std::uint32_t* ids, const TopDownSettings& settings, const H& heuristic)
      : references_(references), ids_(ids), settings_(settings), heuristic_(heuristic) {}

  HierarchyPart build(const ReferenceRange& range, std::uint32_t depth) {
    part_.nodes.reserve(range.count / 2);
    part_.link = build_range(range, depth);
    part_.depth = deepest_ - depth;
    part_.nodes.shrink_to_fit();
    return std::move(part_);
  }

 private:
  using Child = Bvh2Node::Child;

  Child build_range(const ReferenceRange& range, std::uint32_t depth) {
    // What is tested at once is not parted: two blocks, each with a box to test, mostly cost more.
    if (range.count <= settings_.cost.block_size) return make_leaf(range, depth);
    const typename H::Split split = heuristic_.find(range, {references_ + range.first, range.count}, scratch_);
    ReferenceRange left;
    ReferenceRange right;
    switch (decide(range, split, depth, settings_, heuristic_.context().area_scale)) {
      case Decision::leaf:
        return make_leaf(range, depth);
      case Decision::split:
        place_sides(range, split, left, right);
        if constexpr (H::kDividesReferences) {
          divide_and_partition(range, split, left, right);
        } else {
          partition(range, split, left, right);
        }
        break;
      case Decision::halve:
        halve(references_, range, left, right);
        break;
    }
    const auto index = static_cast<std::uint32_t>(part_.nodes.size());
    set_children(part_.nodes.emplace_back(), left.bounds, right.bounds);
    const Child left_child = build_range(left, depth + 1);
    const Child right_child = build_range(right, depth + 1);
    Bvh2Node& node = part_.nodes[index];
    node.child[0] = left_child;
    node.child[1] = right_child;
    return {index, 0};
  }

  Child make_leaf(const ReferenceRange& range, std::uint32_t depth) {
    deepest_ = std::max(deepest_, depth);
    for (std::uint32_t i = range.first; i < range.first + range.count; ++i) ids_[i] = references_[i].primitive();
    return {range.first, range.count};
  }

  // Swaps from both ends, as in quicksort, and collects the bounds of the centres on the way.
  void partition(const ReferenceRange& range, const typename H::Split& split, ReferenceRange& left, ReferenceRange& right) {
    PrimitiveReference* low = references_ + range.first;
    PrimitiveReference* high = low + range.count;
    while (low < high) {
      const bool low_goes_left = split.side(*low) == Side::left;
      const Float4 centre = low->doubled_centre();
      if (low_goes_left) {
        left.centres.grow(centre);
        ++low;
        continue;
      }
      right.centres.grow(centre);
      for (;;) {
        --high;
        if (low == high) break;
        const bool high_goes_left = split.side(*high) == Side::left;
        const Float4 other = high->doubled_centre();
        if (high_goes_left) {
          left.centres.grow(other);
          std::swap(*low, *high);
          ++low;
          break;
        }
        right.centres.grow(other);
      }
    }
  }

  // Sorts into left, both and right; then the left pieces of both join the left, the right pieces go behind the right.
  void divide_and_partition(const ReferenceRange& range, const typename H::Split& split, ReferenceRange& left, ReferenceRange& right) {
    PrimitiveReference* const begin = references_ + range.first;
    PrimitiveReference* const end = begin + range.count;
    const auto is_left = [&](const PrimitiveReference& r) { return split.side(r) == Side::left; };
    const auto is_both = [&](const PrimitiveReference& r) { return split.side(r) == Side::both; };
    PrimitiveReference* const both = std::partition(begin, end, is_left);
    PrimitiveReference* const only_right = std::partition(both, end, is_both);
    PrimitiveReference* next = end;
    for (PrimitiveReference* r = both; r < only_right; ++r) {
      const PrimitiveReference whole = *r;
      heuristic_.divide(split, whole, *r, *next++);
    }
    std::memmove(references_ + right.first, only_right, sizeof(PrimitiveReference) * right.count);
    for (std::uint32_t i = 0; i < left.count; ++i) left.centres.grow(references_[left.first + i].doubled_centre());
    for (std::uint32_t i = 0; i < right.count; ++i) right.centres.grow(references_[right.first + i].doubled_centre());
  }

  PrimitiveReference* references_;
  std::uint32_t* ids_;
  const TopDownSettings& settings_;
  const H& heuristic_;
  HierarchyPart part_;
  typename H::Scratch scratch_;
  std::uint32_t deepest_ = 0;
};

// Builds the top of the hierarchy, moving references between two buffers, and hands smaller ranges to SubtreeBuilder.
template <SplitHeuristic H>
class TopBuilder {
 public:
  TopBuilder(HugeVector<PrimitiveReference>& references, std::uint32_t* ids, const TopDownSettings& settings, const H& heuristic)
      : buffers_{references.data(), nullptr}, ids_(ids), settings_(settings), heuristic_(heuristic) {
    if (references.size() > kTaskSize) spare_.resize(references.size());
    buffers_[1] = spare_.data();
  }

  HierarchyPart build(const ReferenceRange& range, std::uint32_t depth, int buffer) {
    if (range.count <= kTaskSize) return SubtreeBuilder<H>(buffers_[buffer], ids_, settings_, heuristic_).build(range, depth);
    const typename H::Split split = find_split(range, {buffers_[buffer] + range.first, range.count});
    ReferenceRange left;
    ReferenceRange right;
    if (decide(range, split, depth, settings_, heuristic_.context().area_scale) == Decision::split) {
      partition(range, split, buffer, left, right);
      buffer = 1 - buffer;
    } else {
      halve(buffers_[buffer], range, left, right);
    }
    HierarchyPart part;
    parallel_invoke([&] { part.children[0] = std::make_unique<HierarchyPart>(build(left, depth + 1, buffer)); },
                    [&] { part.children[1] = std::make_unique<HierarchyPart>(build(right, depth + 1, buffer)); });
    part.bounds[0] = left.bounds;
    part.bounds[1] = right.bounds;
    part.depth = 1 + std::max(part.children[0]->depth, part.children[1]->depth);
    return part;
  }

 private:
  typename H::Split find_split(const ReferenceRange& range, std::span<const PrimitiveReference> references) const {
    if (range.count > kParallelSize) return heuristic_.find_in_parallel(range, references);
    typename H::Scratch scratch;
    return heuristic_.find(range, references, scratch);
  }

  // Moves the references to the other buffer, those of the left first, keeping their order.
  void partition(const ReferenceRange& range, const typename H::Split& split, int buffer, ReferenceRange& left, ReferenceRange& right) {
    place_sides(range, split, left, right);
    const PrimitiveReference* source = buffers_[buffer] + range.first;
    PrimitiveReference* const target = buffers_[1 - buffer];
    const std::size_t chunk_size = range.count > kParallelSize ? kBuildChunkSize : range.count;
    struct Chunk {
      std::uint32_t count[2] = {0, 0};
      Box4 centres[2] = {Box4::empty(), Box4::empty()};
    };
    std::vector<Chunk> chunks((range.count + chunk_size - 1) / chunk_size);
    parallel_chunks(range.count, chunk_size, [&](std::size_t chunk, std::size_t first, std::size_t last) {
      std::uint32_t count[2] = {0, 0};
      for (std::size_t i = first; i < last; ++i) {
        const Side side = split.side(source[i]);
        count[0] += side != Side::right ? 1 : 0;
        count[1] += side != Side::left ? 1 : 0;
      }
      chunks[chunk].count[0] = count[0];
      chunks[chunk].count[1] = count[1];
    });
    std::uint32_t next_place[2] = {left.first, right.first};
    for (Chunk& chunk : chunks)
      for (int side = 0; side < 2; ++side) next_place[side] += std::exchange(chunk.count[side], next_place[side]);
    parallel_chunks(range.count, chunk_size, [&](std::size_t id, std::size_t first, std::size_t last) {
      std::uint32_t next[2] = {chunks[id].count[0], chunks[id].count[1]};
      Box4 centres[2] = {Box4::empty(), Box4::empty()};
      const auto append = [&](int side, const PrimitiveReference& reference) {
        centres[side].grow(reference.doubled_centre());
        target[next[side]++] = reference;
      };
      for (std::size_t i = first; i < last; ++i) {
        const Side side = split.side(source[i]);
        if constexpr (H::kDividesReferences) {
          if (side == Side::both) {
            PrimitiveReference pieces[2];
            heuristic_.divide(split, source[i], pieces[0], pieces[1]);
            append(0, pieces[0]);
            append(1, pieces[1]);
            continue;
          }
        }
        append(side == Side::left ? 0 : 1, source[i]);
      }
      chunks[id].centres[0] = centres[0];
      chunks[id].centres[1] = centres[1];
    });
    for (const Chunk& chunk : chunks) {
      left.centres.grow(chunk.centres[0]);
      right.centres.grow(chunk.centres[1]);
    }
  }

  PrimitiveReference* buffers_[2];
  std::uint32_t* ids_;
  const TopDownSettings& settings_;
  const H& heuristic_;
  HugeVector<PrimitiveReference> spare_;
};

/// Drives `heuristic` over `list`. `capacity` is the number of references that dividing may lead to, at least list.references.size().
template <SplitHeuristic H>
[[nodiscard]] Bvh2 drive_top_down(ReferenceList list, std::size_t capacity, const TopDownSettings& settings, const H& heuristic) {
  Bvh2 bvh;
  if (list.references.empty()) return bvh;
  bvh.bounds = list.bounds;
  ReferenceRange all = measure_all(list.references);
  all.capacity = static_cast<std::uint32_t>(capacity);
  list.references.resize(capacity);
  bvh.references.resize(capacity);
  if (H::kDividesReferences) std::fill(bvh.references.begin(), bvh.references.end(), kNoReference);
  HierarchyPart root = TopBuilder<H>(list.references, bvh.references.data(), settings, heuristic).build(all, 0, 0);
  list.references = {};
  assemble(root, bvh);
  if (H::kDividesReferences) close_reference_gaps(bvh);
  return bvh;
}

}  // namespace grove::detail
