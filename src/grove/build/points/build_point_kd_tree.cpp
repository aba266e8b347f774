#include "grove/build/points/build_point_kd_tree.h"

#include <algorithm>
#include <limits>

#include "grove/base/error.h"
#include "grove/base/parallel.h"

namespace grove {
namespace {

// A point on its way to a leaf.
template <std::size_t kDimensions>
struct Item {
  float c[kDimensions];
  std::uint32_t id;
};

template <std::size_t kDimensions>
struct Bounds {
  float lower[kDimensions];
  float upper[kDimensions];

  explicit Bounds(const Item<kDimensions>* items, std::size_t count) {
    std::fill_n(lower, kDimensions, std::numeric_limits<float>::infinity());
    std::fill_n(upper, kDimensions, -std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t axis = 0; axis < kDimensions; ++axis) {
        const float c = items[i].c[axis];
        lower[axis] = c < lower[axis] ? c : lower[axis];
        upper[axis] = c > upper[axis] ? c : upper[axis];
      }
    }
  }

  [[nodiscard]] std::uint32_t widest() const {
    std::uint32_t widest = 0;
    for (std::uint32_t axis = 1; axis < kDimensions; ++axis)
      if (upper[axis] - lower[axis] > upper[widest] - lower[widest]) widest = axis;
    return widest;
  }
};

// Moves the items for which `goes_first` holds to the front and returns how many they are. Without branches, as which way an item goes is as good as random:
// every item is exchanged with the first that stays behind, itself at the least (Lomuto's scheme).
template <std::size_t kDimensions, typename GoesFirst>
std::size_t partition(Item<kDimensions>* items, std::size_t count, const GoesFirst& goes_first) {
  std::size_t front = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Item<kDimensions> item = items[i];
    items[i] = items[front];
    items[front] = item;
    front += goes_first(item) ? 1 : 0;
  }
  return front;
}

// A value of a few items from all over, a little to that side of the one sought on which fewer items are, so that these are what is left to look through
// (Floyd and Rivest 1975, "Expected Time Bounds for Selection").
template <std::size_t kDimensions>
float guess(const Item<kDimensions>* items, std::size_t count, std::size_t rank, std::uint32_t axis) {
  constexpr std::size_t kSampleSize = 64;
  constexpr std::size_t kMargin = 4;
  float sample[kSampleSize];
  for (std::size_t i = 0; i < kSampleSize; ++i) sample[i] = items[i * count / kSampleSize].c[axis];
  std::size_t place = rank * kSampleSize / count;
  place = 2 * rank < count ? std::min(place + kMargin, kSampleSize - 1) : std::max(place, kMargin) - kMargin;
  std::nth_element(sample, sample + place, sample + kSampleSize);
  return sample[place];
}

// As std::nth_element by one coordinate, in a third of the time for many.
template <std::size_t kDimensions>
void select(Item<kDimensions>* items, std::size_t count, std::size_t rank, std::uint32_t axis) {
  constexpr std::size_t kFew = 256;
  constexpr int kMostGuesses = 16;
  for (int i = 0; i < kMostGuesses && count > kFew; ++i) {
    const float pivot = guess(items, count, rank, axis);
    const std::size_t below = partition(items, count, [&](const Item<kDimensions>& item) { return item.c[axis] < pivot; });
    if (rank < below) {
      count = below;
      continue;
    }
    const std::size_t equal = partition(items + below, count - below, [&](const Item<kDimensions>& item) { return item.c[axis] <= pivot; });
    if (rank < below + equal) return;
    items += below + equal;
    count -= below + equal;
    rank -= below + equal;
  }
  std::nth_element(items, items + rank, items + count,
                   [axis](const Item<kDimensions>& a, const Item<kDimensions>& b) { return a.c[axis] < b.c[axis]; });
}

template <std::size_t kDimensions>
class Builder {
 public:
  using Tree = PointKdTree<kDimensions>;

  Builder(Tree& tree, HugeVector<Item<kDimensions>>& items) : tree_(tree), items_(items) {}

  void build(std::size_t node, std::size_t first, std::size_t count, const Bounds<kDimensions>& bounds) const {
    if (node >= tree_.nodes.size()) {
      make_leaf(node - tree_.nodes.size(), first, count);
      return;
    }
    Item<kDimensions>* const items = items_.data() + first;
    const std::uint32_t axis = bounds.widest();
    const std::size_t half = count / 2;
    select(items, count, half, axis);
    const Bounds<kDimensions> lower_bounds(items, half);
    const Bounds<kDimensions> upper_bounds(items + half, count - half);
    tree_.nodes[node] = {lower_bounds.upper[axis], upper_bounds.lower[axis], axis};
    constexpr std::size_t kTaskSize = 4096;
    const auto lower = [&] { build(2 * node + 1, first, half, lower_bounds); };
    const auto upper = [&] { build(2 * node + 2, first + half, count - half, upper_bounds); };
    if (count > kTaskSize) {
      parallel_invoke(lower, upper);
    } else {
      lower();
      upper();
    }
  }

 private:
  void make_leaf(std::size_t leaf, std::size_t first, std::size_t count) const {
    typename Tree::Block& block = tree_.blocks[leaf];
    std::uint32_t* const ids = tree_.ids.data() + leaf * Tree::kLeafSize;
    for (std::uint32_t lane = 0; lane < Tree::kLeafSize; ++lane) {
      const bool is_used = lane < count;
      ids[lane] = is_used ? items_[first + lane].id : Tree::kNoPoint;
      for (std::size_t axis = 0; axis < kDimensions; ++axis)
        block.coordinates[axis][lane] = is_used ? items_[first + lane].c[axis] : std::numeric_limits<float>::quiet_NaN();
    }
  }

  Tree& tree_;
  HugeVector<Item<kDimensions>>& items_;
};

// Those that can be used, in order.
template <std::size_t kDimensions>
HugeVector<Item<kDimensions>> list_items(std::span<const Point<kDimensions>> points) {
  constexpr std::size_t kChunk = 65536;
  std::vector<std::size_t> chunk_first((points.size() + kChunk - 1) / kChunk + 1, 0);
  parallel_chunks(points.size(), kChunk, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) chunk_first[chunk + 1] += is_usable_point<kDimensions>(points[i]) ? 1 : 0;
  });
  for (std::size_t chunk = 1; chunk < chunk_first.size(); ++chunk) chunk_first[chunk] += chunk_first[chunk - 1];
  HugeVector<Item<kDimensions>> items(chunk_first.back());
  parallel_chunks(points.size(), kChunk, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    Item<kDimensions>* next = items.data() + chunk_first[chunk];
    for (std::size_t i = first; i < last; ++i) {
      if (!is_usable_point<kDimensions>(points[i])) continue;
      std::copy_n(points[i].data(), kDimensions, next->c);
      next->id = static_cast<std::uint32_t>(i);
      ++next;
    }
  });
  return items;
}

}  // namespace

template <std::size_t kDimensions>
PointKdTree<kDimensions> build_point_kd_tree(std::span<const Point<kDimensions>> points) {
  using Tree = PointKdTree<kDimensions>;
  if (points.size() >= Tree::kNoPoint) throw InputError("a tree may have at most 2^32 - 2 points, not " + std::to_string(points.size()));
  HugeVector<Item<kDimensions>> items = list_items<kDimensions>(points);
  Tree tree;
  if (items.empty()) return tree;
  tree.size = static_cast<std::uint32_t>(items.size());
  while ((items.size() - 1) >> tree.depth >= Tree::kLeafSize) ++tree.depth;
  const std::size_t leaves = std::size_t{1} << tree.depth;
  tree.nodes.resize(leaves - 1);
  tree.blocks.resize(leaves);
  tree.ids.resize(leaves * Tree::kLeafSize);
  const Bounds<kDimensions> bounds(items.data(), items.size());
  std::copy_n(bounds.lower, kDimensions, tree.lower.data());
  std::copy_n(bounds.upper, kDimensions, tree.upper.data());
  Builder<kDimensions>(tree, items).build(0, 0, items.size(), bounds);
  return tree;
}

template PointKdTree<2> build_point_kd_tree(std::span<const Point<2>> points);
template PointKdTree<3> build_point_kd_tree(std::span<const Point<3>> points);
template PointKdTree<4> build_point_kd_tree(std::span<const Point<4>> points);
template PointKdTree<5> build_point_kd_tree(std::span<const Point<5>> points);
template PointKdTree<6> build_point_kd_tree(std::span<const Point<6>> points);
template PointKdTree<7> build_point_kd_tree(std::span<const Point<7>> points);
template PointKdTree<8> build_point_kd_tree(std::span<const Point<8>> points);
template PointKdTree<9> build_point_kd_tree(std::span<const Point<9>> points);
template PointKdTree<10> build_point_kd_tree(std::span<const Point<10>> points);
template PointKdTree<11> build_point_kd_tree(std::span<const Point<11>> points);
template PointKdTree<12> build_point_kd_tree(std::span<const Point<12>> points);
template PointKdTree<13> build_point_kd_tree(std::span<const Point<13>> points);
template PointKdTree<14> build_point_kd_tree(std::span<const Point<14>> points);
template PointKdTree<15> build_point_kd_tree(std::span<const Point<15>> points);
template PointKdTree<16> build_point_kd_tree(std::span<const Point<16>> points);

}  // namespace grove
