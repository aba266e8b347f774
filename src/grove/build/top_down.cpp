#include "grove/build/top_down.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "grove/base/parallel.h"
#include "grove/build/splits/binned.h"

namespace grove {
namespace {

// Ranges below this are built by one task.
constexpr std::uint32_t kTaskSize = 8192;
// Ranges above this are binned and partitioned by several tasks, in chunks of kChunkSize.
constexpr std::uint32_t kParallelSize = 131072;
constexpr std::size_t kChunkSize = 16384;
// From here on ranges are halved: 2^31 references take 31 more levels.
constexpr std::uint32_t kLastFreeDepth = Bvh2::kMaxDepth - 32;

// References [first, first + count) of a buffer, and what the splits need to know of them.
struct Range {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  Box4 bounds = Box4::empty();
  Box4 centres = Box4::empty();  // doubled
};

using Child = Bvh2Node::Child;

Range measure(const PrimitiveReference* references, std::uint32_t first, std::uint32_t count) {
  Range range{first, count};
  for (std::uint32_t i = first; i < first + count; ++i) {
    const Box4 box = references[i].box();
    range.bounds.grow(box);
    range.centres.grow(box.lower + box.upper);
  }
  return range;
}

void set_children(Bvh2Node& node, const Box4& left, const Box4& right) {
  for (int axis = 0; axis < 3; ++axis) {
    node.planes[axis][0] = left.lower[axis];
    node.planes[axis][1] = right.lower[axis];
    node.planes[axis][2] = left.upper[axis];
    node.planes[axis][3] = right.upper[axis];
  }
}

float half_area(const Box4& box, float scale) {
  const Float4 d = (box.upper - box.lower) * splat(scale);
  return d[0] * (d[1] + d[2]) + d[1] * d[2];
}

// What is decided for a range before anything moves.
enum class Decision : std::uint8_t { leaf, split, halve };

Decision decide(const Range& range, const BinnedSplit& split, std::uint32_t depth, const TopDownSettings& settings, float area_scale) {
  const bool may_be_leaf = range.count <= settings.leaf_size;
  if (split.axis < 0 || depth >= kLastFreeDepth) return may_be_leaf ? Decision::leaf : Decision::halve;
  if (!may_be_leaf) return Decision::split;
  const auto area = static_cast<double>(half_area(range.bounds, area_scale));
  const double leaf_cost = settings.cost.intersection * range.count * area;
  const double split_cost = settings.cost.traversal * area + settings.cost.intersection * static_cast<double>(split.cost);
  return leaf_cost <= split_cost ? Decision::leaf : Decision::split;
}

// A finished part of the hierarchy: nodes numbered from 0 whose root is node 0, or a single leaf, or a node over two parts.
struct Part {
  std::vector<Bvh2Node> nodes;
  Child link{};
  std::uint32_t depth = 0;
  std::unique_ptr<Part> children[2];
  Box4 bounds[2];
  std::uint32_t offset = 0;

  [[nodiscard]] bool is_leaf() const { return link.count > 0; }
};

// Builds the subtree of a small range in place, in one task.
class SubtreeBuilder {
 public:
  SubtreeBuilder(PrimitiveReference* references, std::uint32_t* ids, const TopDownSettings& settings, float area_scale)
      : references_(references), ids_(ids), settings_(settings), area_scale_(area_scale) {}

  Part build(const Range& range, std::uint32_t depth) {
    part_.nodes.reserve(range.count / 2);
    part_.link = build_range(range, depth);
    part_.depth = deepest_ - depth;
    part_.nodes.shrink_to_fit();
    return std::move(part_);
  }

 private:
  Child build_range(const Range& range, std::uint32_t depth) {
    if (range.count == 1) return make_leaf(range, depth);
    BinnedSplit split;
    const BinMapping mapping(range.centres, range.count);
    bins_.clear(mapping.bin_count);
    bins_.add(mapping, {references_ + range.first, range.count});
    split = find_binned_split(bins_, mapping, area_scale_);
    Range left;
    Range right;
    switch (decide(range, split, depth, settings_, area_scale_)) {
      case Decision::leaf:
        return make_leaf(range, depth);
      case Decision::split:
        partition(range, mapping, split, left, right);
        break;
      case Decision::halve:
        left = measure(references_, range.first, range.count / 2);
        right = measure(references_, range.first + left.count, range.count - left.count);
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

  Child make_leaf(const Range& range, std::uint32_t depth) {
    deepest_ = std::max(deepest_, depth);
    for (std::uint32_t i = range.first; i < range.first + range.count; ++i) ids_[i] = references_[i].primitive();
    return {range.first, range.count};
  }

  // Swaps from both ends, as in quicksort, and collects the bounds of the centres on the way.
  void partition(const Range& range, const BinMapping& mapping, const BinnedSplit& split, Range& left, Range& right) {
    left.bounds = split.left;
    right.bounds = split.right;
    PrimitiveReference* low = references_ + range.first;
    PrimitiveReference* high = low + range.count;
    const auto goes_left = [&](Float4 centre) { return mapping.bins(centre)[split.axis] < split.bin; };
    while (low < high) {
      const Float4 centre = low->doubled_centre();
      if (goes_left(centre)) {
        left.centres.grow(centre);
        ++low;
        continue;
      }
      right.centres.grow(centre);
      for (;;) {
        --high;
        if (low == high) break;
        const Float4 other = high->doubled_centre();
        if (goes_left(other)) {
          left.centres.grow(other);
          std::swap(*low, *high);
          ++low;
          break;
        }
        right.centres.grow(other);
      }
    }
    left.first = range.first;
    left.count = split.left_count;
    right.first = range.first + split.left_count;
    right.count = range.count - split.left_count;
  }

  PrimitiveReference* references_;
  std::uint32_t* ids_;
  const TopDownSettings& settings_;
  float area_scale_;
  Part part_;
  Bins bins_;
  std::uint32_t deepest_ = 0;
};

// Builds the top of the hierarchy, moving references between two buffers, and hands smaller ranges to SubtreeBuilder.
class TopBuilder {
 public:
  TopBuilder(HugeVector<PrimitiveReference>& references, std::uint32_t* ids, const TopDownSettings& settings, float area_scale)
      : buffers_{references.data(), nullptr}, ids_(ids), settings_(settings), area_scale_(area_scale) {
    if (references.size() > kTaskSize) scratch_.resize(references.size());
    buffers_[1] = scratch_.data();
  }

  Part build(const Range& range, std::uint32_t depth, int buffer) {
    if (range.count <= kTaskSize) return SubtreeBuilder(buffers_[buffer], ids_, settings_, area_scale_).build(range, depth);
    const BinMapping mapping(range.centres, range.count);
    const BinnedSplit split = find_split(range, mapping, buffer);
    Range left;
    Range right;
    if (decide(range, split, depth, settings_, area_scale_) == Decision::split) {
      partition(range, mapping, split, buffer, left, right);
      buffer = 1 - buffer;
    } else {
      left = measure(buffers_[buffer], range.first, range.count / 2);
      right = measure(buffers_[buffer], range.first + left.count, range.count - left.count);
    }
    Part part;
    parallel_invoke([&] { part.children[0] = std::make_unique<Part>(build(left, depth + 1, buffer)); },
                    [&] { part.children[1] = std::make_unique<Part>(build(right, depth + 1, buffer)); });
    part.bounds[0] = left.bounds;
    part.bounds[1] = right.bounds;
    part.depth = 1 + std::max(part.children[0]->depth, part.children[1]->depth);
    return part;
  }

 private:
  BinnedSplit find_split(const Range& range, const BinMapping& mapping, int buffer) const {
    const PrimitiveReference* references = buffers_[buffer] + range.first;
    const std::size_t chunk_size = range.count > kParallelSize ? kChunkSize : range.count;
    std::vector<Bins> bins((range.count + chunk_size - 1) / chunk_size);
    parallel_chunks(range.count, chunk_size, [&](std::size_t chunk, std::size_t first, std::size_t last) {
      bins[chunk].clear(mapping.bin_count);
      bins[chunk].add(mapping, {references + first, last - first});
    });
    for (std::size_t chunk = 1; chunk < bins.size(); ++chunk) bins[0].merge(bins[chunk], mapping.bin_count);
    return find_binned_split(bins[0], mapping, area_scale_);
  }

  // Moves the references to the other buffer, those of the left first, keeping their order.
  void partition(const Range& range, const BinMapping& mapping, const BinnedSplit& split, int buffer, Range& left, Range& right) {
    const PrimitiveReference* source = buffers_[buffer] + range.first;
    PrimitiveReference* target = buffers_[1 - buffer] + range.first;
    const std::size_t chunk_size = range.count > kParallelSize ? kChunkSize : range.count;
    struct Chunk {
      std::uint32_t left_count = 0;
      Box4 centres[2];
    };
    std::vector<Chunk> chunks((range.count + chunk_size - 1) / chunk_size);
    const auto goes_left = [&](Float4 centre) { return mapping.bins(centre)[split.axis] < split.bin; };
    parallel_chunks(range.count, chunk_size, [&](std::size_t chunk, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) chunks[chunk].left_count += goes_left(source[i].doubled_centre()) ? 1 : 0;
    });
    std::uint32_t left_count = 0;
    for (Chunk& chunk : chunks) left_count += std::exchange(chunk.left_count, left_count);
    parallel_chunks(range.count, chunk_size, [&](std::size_t id, std::size_t first, std::size_t last) {
      Chunk& chunk = chunks[id];
      // Before this chunk there are first references, chunk.left_count of which went left.
      std::size_t next[2] = {chunk.left_count, split.left_count + first - chunk.left_count};
      Box4 centres[2] = {Box4::empty(), Box4::empty()};
      for (std::size_t i = first; i < last; ++i) {
        const Float4 centre = source[i].doubled_centre();
        const int side = goes_left(centre) ? 0 : 1;
        centres[side].grow(centre);
        target[next[side]++] = source[i];
      }
      chunk.centres[0] = centres[0];
      chunk.centres[1] = centres[1];
    });
    left = {range.first, split.left_count, split.left, Box4::empty()};
    right = {range.first + split.left_count, range.count - split.left_count, split.right, Box4::empty()};
    for (const Chunk& chunk : chunks) {
      left.centres.grow(chunk.centres[0]);
      right.centres.grow(chunk.centres[1]);
    }
  }

  PrimitiveReference* buffers_[2];
  std::uint32_t* ids_;
  const TopDownSettings& settings_;
  float area_scale_;
  HugeVector<PrimitiveReference> scratch_;
};

// Gives each part its place in depth-first order; returns the end.
std::uint32_t place(Part& part, std::uint32_t offset) {
  part.offset = offset;
  if (part.children[0] == nullptr) return offset + static_cast<std::uint32_t>(part.nodes.size());
  return place(*part.children[1], place(*part.children[0], offset + 1));
}

Child copy_nodes(Part& part, Bvh2Node* nodes) {
  if (part.is_leaf()) return part.link;
  if (part.children[0] == nullptr) {
    for (std::size_t i = 0; i < part.nodes.size(); ++i) {
      Bvh2Node node = part.nodes[i];
      for (int child = 0; child < 2; ++child)
        if (node.child[child].count == 0) node.child[child].first += part.offset;
      nodes[part.offset + i] = node;
    }
    part.nodes = {};
    return {part.offset, 0};
  }
  Child children[2];
  parallel_invoke([&] { children[0] = copy_nodes(*part.children[0], nodes); }, [&] { children[1] = copy_nodes(*part.children[1], nodes); });
  Bvh2Node& node = nodes[part.offset];
  set_children(node, part.bounds[0], part.bounds[1]);
  node.child[0] = children[0];
  node.child[1] = children[1];
  return {part.offset, 0};
}

Range measure_all(const HugeVector<PrimitiveReference>& references) {
  const std::size_t chunk_size = kChunkSize;
  std::vector<Range> chunks((references.size() + chunk_size - 1) / chunk_size);
  parallel_chunks(references.size(), chunk_size, [&](std::size_t id, std::size_t first, std::size_t last) {
    chunks[id] = measure(references.data(), static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last - first));
  });
  Range all{0, static_cast<std::uint32_t>(references.size())};
  for (const Range& chunk : chunks) {
    all.bounds.grow(chunk.bounds);
    all.centres.grow(chunk.centres);
  }
  return all;
}

}  // namespace

Bvh2 build_binned(ReferenceList list, const TopDownSettings& settings) {
  Bvh2 bvh;
  if (list.references.empty()) return bvh;
  bvh.bounds = list.bounds;
  bvh.references.resize(list.references.size());
  const float area_scale = AreaMeasure(list.bounds).scale();
  Part root = [&] {
    TopBuilder builder(list.references, bvh.references.data(), settings, area_scale);
    return builder.build(measure_all(list.references), 0, 0);
  }();
  list.references = {};
  bvh.depth = root.depth;
  bvh.nodes.resize(place(root, 0));
  copy_nodes(root, bvh.nodes.data());
  return bvh;
}

}  // namespace grove
