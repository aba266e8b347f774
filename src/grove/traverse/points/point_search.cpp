#include "grove/traverse/points/point_search.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "grove/base/check.h"
#include "grove/base/parallel.h"
#include "grove/math/float4.h"

namespace grove {
namespace {

// Fewer queries are not worth a task.
constexpr std::size_t kQueriesATask = 256;

// A neighbour as a number in the order of neighbours: distances are not negative, so their bits are in their order.
std::uint64_t key_of(float squared_distance, std::uint32_t id) {
  return std::uint64_t{std::bit_cast<std::uint32_t>(squared_distance)} << 32U | id;
}
std::uint64_t key_of(const PointNeighbour& neighbour) {
  return key_of(neighbour.squared_distance, neighbour.id);
}

/// Keeps the nearest of those that it is offered, in order.
class NearestCollector {
 public:
  explicit NearestCollector(std::span<PointNeighbour> nearest) : nearest_(nearest) {}

  /// Points farther away are of no use.
  [[nodiscard]] float limit() const { return nearest_.back().squared_distance; }
  void offer(float squared_distance, std::uint32_t id) {
    const std::uint64_t key = key_of(squared_distance, id);
    std::size_t i = nearest_.size() - 1;
    if (key >= key_of(nearest_[i])) return;
    for (; i > 0 && key < key_of(nearest_[i - 1]); --i) nearest_[i] = nearest_[i - 1];
    nearest_[i] = {id, squared_distance};
  }

 private:
  std::span<PointNeighbour> nearest_;
};

/// Keeps all within a radius.
class RadiusCollector {
 public:
  RadiusCollector(float squared_radius, std::vector<PointNeighbour>& found) : limit_(squared_radius), found_(found) {}

  [[nodiscard]] float limit() const { return limit_; }
  void offer(float squared_distance, std::uint32_t id) { found_.push_back({id, squared_distance}); }

 private:
  float limit_;
  std::vector<PointNeighbour>& found_;
};

// Sum of squares, in order.
template <std::size_t kDimensions>
float squared_length(const float (&v)[kDimensions]) {
  float sum = v[0] * v[0];
  for (std::size_t axis = 1; axis < kDimensions; ++axis) sum += v[axis] * v[axis];
  return sum;
}

// Offers what is near enough.
template <std::size_t kDimensions, typename Collector>
void test_leaf(const PointKdTree<kDimensions>& tree, std::uint32_t leaf, const Point<kDimensions>& query, Collector& collector) {
  constexpr std::uint32_t kLanes = 4;
  const auto& block = tree.blocks[leaf];
  const std::uint32_t* const ids = tree.ids.data() + std::size_t{leaf} * PointKdTree<kDimensions>::kLeafSize;
  for (std::uint32_t first = 0; first < PointKdTree<kDimensions>::kLeafSize; first += kLanes) {
    Float4 sum{};
    for (std::size_t axis = 0; axis < kDimensions; ++axis) {
      const Float4 difference = load4(block.coordinates[axis] + first) - splat(query[axis]);
      sum = axis == 0 ? difference * difference : sum + difference * difference;
    }
    // False for NaN, where there is no point.
    auto near = static_cast<unsigned>(four_lanes(sum <= splat(collector.limit())));
    for (; near != 0; near &= near - 1) {
      const int lane = std::countr_zero(near);
      collector.offer(sum[lane], ids[first + static_cast<std::uint32_t>(lane)]);
    }
  }
}

/// Offers a collector the points that may be near enough, nearer cells first. The bound of a cell is the distance of the query from the box that the planes
/// crossed so far leave of it, axis by axis (Arya and Mount 1993, "Algorithms for Fast Vector Quantization", but summed up anew instead of adjusted).
template <std::size_t kDimensions, typename Collector>
void visit_near(const PointKdTree<kDimensions>& tree, const Point<kDimensions>& query, Collector& collector) {
  using Tree = PointKdTree<kDimensions>;
  struct Entry {
    float away[kDimensions];  // how far the query is from the cell, by axis
    float bound;
    std::uint32_t node;
  };
  if (tree.blocks.empty() || !is_usable_point<kDimensions>(query)) return;
  Entry stack[Tree::kMaxDepth];
  std::uint32_t stack_size = 0;
  Entry here;
  for (std::size_t axis = 0; axis < kDimensions; ++axis)
    here.away[axis] = std::fmax(0.0F, std::fmax(tree.lower[axis] - query[axis], query[axis] - tree.upper[axis]));
  here.bound = squared_length(here.away);
  here.node = 0;
  if (here.bound > collector.limit()) return;
  const PointKdNode* const nodes = tree.nodes.data();
  const auto interior = static_cast<std::uint32_t>(tree.nodes.size());
  for (;;) {
    while (here.node < interior) {
      const PointKdNode node = nodes[here.node];
      const float beyond_lower = query[node.axis] - node.lower_end;
      const float before_upper = node.upper_begin - query[node.axis];
      const bool is_upper_nearer = beyond_lower > before_upper;
      Entry& far = stack[stack_size];
      far = here;
      far.away[node.axis] = is_upper_nearer ? beyond_lower : before_upper;
      far.bound = squared_length(far.away);
      far.node = 2 * here.node + (is_upper_nearer ? 1 : 2);
      stack_size += far.bound <= collector.limit() ? 1 : 0;
      here.node = 2 * here.node + (is_upper_nearer ? 2 : 1);
    }
    test_leaf(tree, here.node - interior, query, collector);
    do {
      if (stack_size == 0) return;
      --stack_size;
    } while (stack[stack_size].bound > collector.limit());
    here = stack[stack_size];
  }
}

template <std::size_t kDimensions>
void append_in_range(const PointKdTree<kDimensions>& tree, const PointRange<kDimensions>& range, std::vector<std::uint32_t>& found) {
  using Tree = PointKdTree<kDimensions>;
  if (tree.blocks.empty()) return;
  const auto interior = static_cast<std::uint32_t>(tree.nodes.size());
  const auto before = static_cast<std::ptrdiff_t>(found.size());
  std::uint32_t stack[Tree::kMaxDepth + 1];
  std::uint32_t stack_size = 0;
  stack[stack_size++] = 0;
  while (stack_size > 0) {
    const std::uint32_t number = stack[--stack_size];
    if (number < interior) {
      const PointKdNode node = tree.nodes[number];
      if (range.upper[node.axis] >= node.upper_begin) stack[stack_size++] = 2 * number + 2;
      if (range.lower[node.axis] <= node.lower_end) stack[stack_size++] = 2 * number + 1;
      continue;
    }
    const auto& block = tree.blocks[number - interior];
    for (std::uint32_t lane = 0; lane < Tree::kLeafSize; ++lane) {
      bool is_inside = true;
      for (std::size_t axis = 0; axis < kDimensions; ++axis)
        is_inside = is_inside && block.coordinates[axis][lane] >= range.lower[axis] && block.coordinates[axis][lane] <= range.upper[axis];
      if (is_inside) found.push_back(tree.ids[std::size_t{number - interior} * Tree::kLeafSize + lane]);
    }
  }
  std::sort(found.begin() + before, found.end());
}

bool is_before(const PointNeighbour& a, const PointNeighbour& b) {
  return key_of(a) < key_of(b);
}

template <std::size_t kDimensions>
void append_within(const PointKdTree<kDimensions>& tree, const Point<kDimensions>& query, float radius,
                   std::vector<PointNeighbour>& found) {
  if (!(radius >= 0.0F)) return;
  RadiusCollector collector(std::fmin(radius * radius, std::numeric_limits<float>::max()), found);
  const auto before = static_cast<std::ptrdiff_t>(found.size());
  visit_near(tree, query, collector);
  std::sort(found.begin() + before, found.end(), is_before);
}

/// Puts together what append(i, found) appends for each of `count` queries.
template <typename T, typename Append>
BatchAnswers<T> answer_all(std::size_t count, const Append& append) {
  BatchAnswers<T> answers;
  answers.first.assign(count + 1, 0);
  std::vector<std::vector<T>> chunks((count + kQueriesATask - 1) / kQueriesATask);
  parallel_chunks(count, kQueriesATask, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      append(i, chunks[chunk]);
      answers.first[i + 1] = chunks[chunk].size();
    }
  });
  std::vector<std::size_t> chunk_first(chunks.size() + 1, 0);
  for (std::size_t chunk = 0; chunk < chunks.size(); ++chunk) chunk_first[chunk + 1] = chunk_first[chunk] + chunks[chunk].size();
  answers.found.resize(chunk_first.back());
  parallel_chunks(count, kQueriesATask, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) answers.first[i + 1] += chunk_first[chunk];
    std::copy(chunks[chunk].begin(), chunks[chunk].end(), answers.found.begin() + static_cast<std::ptrdiff_t>(chunk_first[chunk]));
  });
  return answers;
}

}  // namespace

template <std::size_t kDimensions>
void PointSearch<kDimensions>::nearest(const Query& query, std::span<PointNeighbour> nearest) const {
  std::fill(nearest.begin(), nearest.end(), PointNeighbour());
  if (nearest.empty()) return;
  NearestCollector collector(nearest);
  visit_near(tree_, query, collector);
}

template <std::size_t kDimensions>
void PointSearch<kDimensions>::nearest(std::span<const Query> queries, std::size_t k, std::span<PointNeighbour> nearest) const {
  GROVE_CHECK(nearest.size() == k * queries.size());
  parallel_for(queries.size(), kQueriesATask, [&](std::size_t i) { this->nearest(queries[i], nearest.subspan(k * i, k)); });
}

template <std::size_t kDimensions>
std::vector<PointNeighbour> PointSearch<kDimensions>::within(const Query& query, float radius) const {
  std::vector<PointNeighbour> found;
  append_within(tree_, query, radius, found);
  return found;
}

template <std::size_t kDimensions>
BatchAnswers<PointNeighbour> PointSearch<kDimensions>::within(std::span<const Query> queries, float radius) const {
  return answer_all<PointNeighbour>(
      queries.size(), [&](std::size_t i, std::vector<PointNeighbour>& found) { append_within(tree_, queries[i], radius, found); });
}

template <std::size_t kDimensions>
std::vector<std::uint32_t> PointSearch<kDimensions>::in_range(const PointRange<kDimensions>& range) const {
  std::vector<std::uint32_t> found;
  append_in_range(tree_, range, found);
  return found;
}

template <std::size_t kDimensions>
BatchAnswers<std::uint32_t> PointSearch<kDimensions>::in_range(std::span<const PointRange<kDimensions>> ranges) const {
  return answer_all<std::uint32_t>(ranges.size(),
                                   [&](std::size_t i, std::vector<std::uint32_t>& found) { append_in_range(tree_, ranges[i], found); });
}

template class PointSearch<2>;
template class PointSearch<3>;
template class PointSearch<4>;
template class PointSearch<5>;
template class PointSearch<6>;
template class PointSearch<7>;
template class PointSearch<8>;
template class PointSearch<9>;
template class PointSearch<10>;
template class PointSearch<11>;
template class PointSearch<12>;
template class PointSearch<13>;
template class PointSearch<14>;
template class PointSearch<15>;
template class PointSearch<16>;

}  // namespace grove
