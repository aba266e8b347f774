// Searches among points in several numbers of dimensions: answers are those of brute force, to the bit and in order, also for points that coincide, lie on a
// lattice, or cannot be used.

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "grove/base/random.h"
#include "grove/build/points/build_point_kd_tree.h"
#include "grove/traverse/points/point_search.h"

namespace grove {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

template <std::size_t kDimensions>
using Points = std::vector<Point<kDimensions>>;

template <std::size_t kDimensions, typename Coordinate>
Points<kDimensions> make_points(std::size_t count, const Coordinate& coordinate) {
  Points<kDimensions> points(count);
  for (Point<kDimensions>& point : points)
    for (float& c : point) c = coordinate();
  return points;
}

// Every neighbour, nearest first.
template <std::size_t kDimensions>
std::vector<PointNeighbour> all_neighbours(const Points<kDimensions>& points, const Point<kDimensions>& query) {
  std::vector<PointNeighbour> all;
  if (!is_usable_point<kDimensions>(query)) return all;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (!is_usable_point<kDimensions>(points[i])) continue;
    float sum = 0.0F;
    for (std::size_t axis = 0; axis < kDimensions; ++axis) sum += (points[i][axis] - query[axis]) * (points[i][axis] - query[axis]);
    all.push_back({i, sum});
  }
  std::sort(all.begin(), all.end(), [](const PointNeighbour& a, const PointNeighbour& b) {
    return a.squared_distance != b.squared_distance ? a.squared_distance < b.squared_distance : a.id < b.id;
  });
  return all;
}

template <std::size_t kDimensions>
std::vector<std::uint32_t> all_in_range(const Points<kDimensions>& points, const PointRange<kDimensions>& range) {
  std::vector<std::uint32_t> inside;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    bool is_inside = is_usable_point<kDimensions>(points[i]);
    for (std::size_t axis = 0; axis < kDimensions; ++axis)
      is_inside = is_inside && points[i][axis] >= range.lower[axis] && points[i][axis] <= range.upper[axis];
    if (is_inside) inside.push_back(i);
  }
  return inside;
}

template <std::size_t kDimensions>
void expect_nearest_of_brute_force(const PointSearch<kDimensions>& search, const Points<kDimensions>& points,
                                   const Point<kDimensions>& query) {
  const std::vector<PointNeighbour> all = all_neighbours(points, query);
  for (const std::size_t k : {std::size_t{1}, std::size_t{4}, std::size_t{19}, points.size() + 3}) {
    std::vector<PointNeighbour> nearest(k, {7, 7.0F});
    search.nearest(query, nearest);
    std::vector<PointNeighbour> expected(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(k, all.size())));
    expected.resize(k);
    EXPECT_EQ(nearest, expected);
  }
}

template <std::size_t kDimensions>
void expect_within_of_brute_force(const PointSearch<kDimensions>& search, const Points<kDimensions>& points,
                                  const Point<kDimensions>& query) {
  const std::vector<PointNeighbour> all = all_neighbours(points, query);
  // Radii that end at a point exactly among them.
  std::vector<float> radii{0.0F, 0.1F, 1.0F, 1e9F, kInfinity};
  if (all.size() > 5) radii.push_back(std::sqrt(all[5].squared_distance));
  for (const float radius : radii) {
    std::vector<PointNeighbour> expected;
    for (const PointNeighbour& neighbour : all)
      if (neighbour.squared_distance <= radius * radius) expected.push_back(neighbour);
    EXPECT_EQ(search.within(query, radius), expected);
  }
  EXPECT_TRUE(search.within(query, -1.0F).empty());
  EXPECT_TRUE(search.within(query, kNan).empty());
}

template <std::size_t kDimensions>
void expect_ranges_of_brute_force(const PointSearch<kDimensions>& search, const Points<kDimensions>& points,
                                  const Point<kDimensions>& corner) {
  for (const float side : {0.0F, 0.25F, 2.0F, 1e30F, -0.5F}) {
    PointRange<kDimensions> range{corner, corner};
    for (float& c : range.upper) c += side;
    EXPECT_EQ(search.in_range(range), all_in_range(points, range));
    // Open to one side.
    range.lower[0] = -kInfinity;
    EXPECT_EQ(search.in_range(range), all_in_range(points, range));
  }
}

template <std::size_t kDimensions>
void expect_answers_of_brute_force(const Points<kDimensions>& points, std::uint64_t seed) {
  const PointKdTree<kDimensions> tree = build_point_kd_tree<kDimensions>(points);
  ASSERT_EQ(tree.validate(points.size()), "");
  const PointSearch<kDimensions> search(tree);
  Random random(seed);
  Points<kDimensions> queries = make_points<kDimensions>(8, [&] { return random.next_float(-0.5F, 1.5F); });
  for (int i = 0; i < 4 && !points.empty(); ++i) queries.push_back(points[random.next_u32(static_cast<std::uint32_t>(points.size()))]);
  queries.push_back(queries[0]);
  queries.back()[1] = kNan;
  queries.push_back(queries[1]);
  queries.back()[0] = 2e18F;
  for (const Point<kDimensions>& query : queries) {
    expect_nearest_of_brute_force(search, points, query);
    expect_within_of_brute_force(search, points, query);
    expect_ranges_of_brute_force(search, points, query);
  }
}

template <typename Dimensions>
class PointSearchTest : public testing::Test {};

template <std::size_t kCount>
using Dimensions = std::integral_constant<std::size_t, kCount>;

using SomeDimensions = testing::Types<Dimensions<2>, Dimensions<3>, Dimensions<4>, Dimensions<7>, Dimensions<16>>;
TYPED_TEST_SUITE(PointSearchTest, SomeDimensions);

TYPED_TEST(PointSearchTest, FindsWhatBruteForceFinds) {
  constexpr std::size_t kDimensions = TypeParam::value;
  for (const std::size_t count : {0, 1, 2, 7, 8, 9, 16, 17, 100, 1000}) {
    Random random(count + 1);
    expect_answers_of_brute_force(make_points<kDimensions>(count, [&] { return random.next_float(); }), 1);
  }
}

TYPED_TEST(PointSearchTest, FindsClusters) {
  constexpr std::size_t kDimensions = TypeParam::value;
  Random random(2);
  expect_answers_of_brute_force(make_points<kDimensions>(2000, [&] { return std::pow(random.next_float(), 9.0F); }), 2);
}

TYPED_TEST(PointSearchTest, PrefersLowerNumbersOfPointsThatAreAsFar) {
  constexpr std::size_t kDimensions = TypeParam::value;
  Random random(3);
  expect_answers_of_brute_force(make_points<kDimensions>(1500, [&] { return 0.5F * static_cast<float>(random.next_u32(3)); }), 3);
  expect_answers_of_brute_force(make_points<kDimensions>(600, [] { return 0.25F; }), 4);
}

TYPED_TEST(PointSearchTest, LeavesOutPointsThatCanNotBeUsed) {
  constexpr std::size_t kDimensions = TypeParam::value;
  Random random(5);
  Points<kDimensions> points = make_points<kDimensions>(500, [&] { return random.next_float(); });
  for (std::size_t i = 0; i < points.size(); i += 3) points[i][i % kDimensions] = i % 2 == 0 ? kNan : i % 5 == 0 ? -kInfinity : 1.5e18F;
  points[1].fill(1e18F);
  points[2].fill(-1e18F);
  expect_answers_of_brute_force(points, 5);
  expect_answers_of_brute_force(make_points<kDimensions>(50, [] { return kNan; }), 6);
}

TYPED_TEST(PointSearchTest, AnswersBatchesAsSingleQueries) {
  constexpr std::size_t kDimensions = TypeParam::value;
  Random random(7);
  const Points<kDimensions> points = make_points<kDimensions>(3000, [&] { return random.next_float(); });
  const Points<kDimensions> queries = make_points<kDimensions>(1001, [&] { return random.next_float(); });
  const PointKdTree<kDimensions> tree = build_point_kd_tree<kDimensions>(points);
  const PointSearch<kDimensions> search(tree);
  constexpr std::size_t kNearest = 5;
  std::vector<PointNeighbour> nearest(kNearest * queries.size());
  search.nearest(queries, kNearest, nearest);
  const BatchAnswers<PointNeighbour> within = search.within(queries, 0.3F);
  std::vector<PointRange<kDimensions>> ranges;
  for (const Point<kDimensions>& query : queries) {
    ranges.push_back({query, query});
    for (float& c : ranges.back().upper) c += 0.4F;
  }
  const BatchAnswers<std::uint32_t> inside = search.in_range(ranges);
  std::size_t differences = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    std::vector<PointNeighbour> single(kNearest);
    search.nearest(queries[i], single);
    differences += std::equal(single.begin(), single.end(), nearest.begin() + static_cast<std::ptrdiff_t>(kNearest * i)) ? 0 : 1;
    differences += std::ranges::equal(within.of(i), search.within(queries[i], 0.3F)) ? 0 : 1;
    differences += std::ranges::equal(inside.of(i), search.in_range(ranges[i])) ? 0 : 1;
  }
  EXPECT_EQ(differences, 0U);
  EXPECT_EQ(search.within(Points<kDimensions>(), 1.0F).first.size(), 1U);
}

TEST(PointKdTree, IsTheSameForAnyNumberOfThreads) {
  Random random(8);
  const Points<3> points = make_points<3>(200000, [&] { return std::pow(random.next_float(), 4.0F); });
  PointKdTree<3> first;
  for (const int threads : {1, 2, 3, 8}) {
    const oneapi::tbb::global_control allowed(oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    const PointKdTree<3> tree = oneapi::tbb::task_arena(threads).execute([&] { return build_point_kd_tree<3>(points); });
    ASSERT_EQ(tree.validate(points.size()), "");
    if (threads == 1) {
      first = tree;
      continue;
    }
    EXPECT_EQ(tree.ids, first.ids) << threads << " threads";
    ASSERT_EQ(tree.nodes.size(), first.nodes.size());
    EXPECT_EQ(std::memcmp(tree.nodes.data(), first.nodes.data(), tree.nodes.size() * sizeof(PointKdNode)), 0) << threads << " threads";
    EXPECT_EQ(std::memcmp(tree.blocks.data(), first.blocks.data(), tree.blocks.size() * sizeof(PointKdTree<3>::Block)), 0)
        << threads << " threads";
  }
}

// Orders that defeat guesses of a median, and many that are equal.
TEST(PointKdTree, IsBalancedForAnyOrder) {
  const auto depth_of = [](const auto& coordinate) {
    std::size_t i = 0;
    Points<2> points = make_points<2>(100000, [&] { return coordinate(i++); });
    const PointKdTree<2> tree = build_point_kd_tree<2>(points);
    EXPECT_EQ(tree.validate(points.size()), "");
    return tree.depth;
  };
  EXPECT_EQ(depth_of([](std::size_t i) { return static_cast<float>(i); }), 14U);
  EXPECT_EQ(depth_of([](std::size_t i) { return -static_cast<float>(i); }), 14U);
  EXPECT_EQ(depth_of([](std::size_t i) { return static_cast<float>(i % 2); }), 14U);
  EXPECT_EQ(depth_of([](std::size_t i) { return static_cast<float>(i < 99990 ? 0 : i); }), 14U);
  EXPECT_EQ(depth_of([](std::size_t i) { return std::ldexp(1.0F, -static_cast<int>(i % 140)); }), 14U);
  EXPECT_EQ(depth_of([](std::size_t i) { return static_cast<float>((i * 3125) % 100000 / 1563); }), 14U);
}

RC_GTEST_PROP(PointSearchProperty, NearestOnALatticeEqualBruteForce, ()) {
  const auto coordinate = rc::gen::map(rc::gen::inRange(-4, 5), [](int c) { return 0.5F * static_cast<float>(c); });
  const auto point = rc::gen::container<std::array<float, 3>>(coordinate);
  const auto points = *rc::gen::container<Points<3>>(point);
  const Point<3> query = *point;
  const std::size_t k = *rc::gen::inRange<std::size_t>(1, 40);
  const PointKdTree<3> tree = build_point_kd_tree<3>(points);
  RC_ASSERT(tree.validate(points.size()).empty());
  std::vector<PointNeighbour> expected = all_neighbours(points, query);
  expected.resize(k);
  std::vector<PointNeighbour> nearest(k);
  PointSearch<3>(tree).nearest(query, nearest);
  RC_ASSERT(nearest == expected);
}

}  // namespace
}  // namespace grove
