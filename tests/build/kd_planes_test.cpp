// The planes that kd-tree builders choose, against counting and trying all.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "build/sample_meshes.h"
#include "grove/build/kd_tree/binned_planes.h"
#include "grove/build/kd_tree/exact_planes.h"
#include "grove/build/kd_tree/median_planes.h"

namespace grove {
namespace {

// Boxes with corners on a lattice, some of them flat, so that many begin and end at the same planes.
References boxes_on_a_lattice(std::uint32_t count, std::uint32_t steps, Random& random) {
  References references;
  references.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
      const float step = axis == 2 ? 0.5F : 1.0F;  // as in cell_of
      const float a = step * static_cast<float>(random.next_u32(steps + 1));
      const float b = step * static_cast<float>(random.next_u32(steps + 1));
      box.lower[axis] = std::min(a, b);
      box.upper[axis] = std::max(a, b);
    }
    references.push_back(make_reference(box, i));
  }
  return references;
}

Box4 cell_of(float side) {
  return {Float4{0.0F, 0.0F, 0.0F, 0.0F}, Float4{side, side, 0.5F * side, 0.0F}};
}

KdCostContext costs(float empty_bonus = 0.2F) {
  return {0.125F, {.traversal = 1.0, .intersection = 1.0}, empty_bonus};
}

// The cost of a plane in double, by counting.
double counted_cost(const References& references, const Box4& cell, KdPlane plane, double empty_bonus) {
  plane.lower_count = plane.upper_count = 0;
  for (const PrimitiveReference& reference : references) plane.count(plane.side(reference));
  Box boxes[2] = {cell.box(), cell.box()};
  boxes[0].upper[plane.axis] = boxes[1].lower[plane.axis] = plane.position;
  const double area = cell.box().half_area();
  const double cost = 1.0 + boxes[0].half_area() / area * plane.lower_count + boxes[1].half_area() / area * plane.upper_count;
  return cost * (plane.lower_count == 0 || plane.upper_count == 0 ? 1.0 - empty_bonus : 1.0);
}

void expect_counts_of(const References& references, const KdPlane& plane) {
  KdPlane counted = plane;
  counted.lower_count = counted.upper_count = 0;
  for (const PrimitiveReference& reference : references) counted.count(plane.side(reference));
  EXPECT_EQ(counted.lower_count, plane.lower_count);
  EXPECT_EQ(counted.upper_count, plane.upper_count);
}

TEST(ExactPlanes, AreTheCheapestOfAll) {
  Random random(1);
  const ReferenceClipper& clipper = NoClipper();
  for (int trial = 0; trial < 300; ++trial) {
    const std::uint32_t steps = 4 + random.next_u32(12);
    const References references = boxes_on_a_lattice(1 + random.next_u32(40), steps, random);
    const Box4 cell = cell_of(static_cast<float>(steps));
    const float bonus = trial % 2 == 0 ? 0.0F : 0.3F;
    const ExactPlanes finder(costs(bonus), clipper);
    const EventSet set = ExactPlanes::make_set(references);
    ExactPlanes::Scratch scratch;
    const KdPlane found = finder.find(set, cell, scratch);
    ASSERT_TRUE(found.is_possible);
    expect_counts_of(references, found);
    EXPECT_NEAR(found.cost, counted_cost(references, cell, found, bonus), 1e-4);
    // Every plane through the lattice, and planes between.
    for (int axis = 0; axis < 3; ++axis) {
      for (float position = 0.25F; position < static_cast<float>(steps); position += 0.25F) {
        if (!is_inside(cell, axis, position)) continue;
        for (const Side side : {Side::left, Side::right})
          EXPECT_GE(counted_cost(references, cell, {true, axis, position, side}, bonus), found.cost - 1e-4) << axis << " " << position;
      }
    }
  }
}

// Sorted, and those that listing anew would give.
void expect_events_of(const EventSet& set) {
  EventSet anew = ExactPlanes::make_set(set.references);
  for (int axis = 0; axis < 3; ++axis) {
    KdEvents events = set.events[static_cast<std::size_t>(axis)];
    for (std::size_t i = 1; i < events.size(); ++i) ASSERT_FALSE(events[i].renumbered(0) < events[i - 1].renumbered(0)) << i;
    std::sort(events.begin(), events.end());
    EXPECT_TRUE(events == anew.events[static_cast<std::size_t>(axis)]);
  }
}

void expect_events_stay_in_order(std::uint32_t count, std::uint32_t steps, bool clip) {
  Random random(2);
  const TriangleMesh mesh = testing::pebbles(count, 0.3F, 3);
  const GeometryClipper<TriangleMesh> clipper(mesh);
  const NoClipper no_clipper;
  const ExactPlanes finder(costs(), clip ? static_cast<const ReferenceClipper&>(clipper) : no_clipper);
  const References references = clip ? list_references(mesh).references : boxes_on_a_lattice(count, steps, random);
  const Box4 cell = clip ? Box4{splat(-0.5F), splat(1.5F)} : cell_of(static_cast<float>(steps));
  ExactPlanes::Scratch scratch;
  const EventSet set = ExactPlanes::make_set(references);
  const KdPlane plane = finder.find(set, cell, scratch);
  ASSERT_TRUE(plane.is_possible);
  expect_counts_of(references, plane);
  EventSet lower;
  EventSet upper;
  EventSet* const sides[2] = {&lower, &upper};
  finder.part(set, plane, sides, scratch);
  EXPECT_LE(lower.references.size(), plane.lower_count);
  EXPECT_LE(upper.references.size(), plane.upper_count);
  if (!clip) {
    EXPECT_EQ(lower.references.size(), plane.lower_count);
    EXPECT_EQ(upper.references.size(), plane.upper_count);
  }
  for (const PrimitiveReference& reference : lower.references) ASSERT_LE(reference.upper[plane.axis], plane.position);
  for (const PrimitiveReference& reference : upper.references) ASSERT_GE(reference.lower[plane.axis], plane.position);
  expect_events_of(lower);
  expect_events_of(upper);
}

TEST(ExactPlanes, KeepEventsInOrderWhenParting) {
  expect_events_stay_in_order(300, 16, false);
  expect_events_stay_in_order(3000, 1000, true);
}

TEST(ExactPlanes, KeepEventsInOrderInParallel) {
  expect_events_stay_in_order(100000, 16, false);
  expect_events_stay_in_order(100000, 100000, false);
  expect_events_stay_in_order(100000, 1000, true);
}

TEST(ExactPlanes, AreTheSameInParallel) {
  // Far more references than one chunk holds at few positions: a position's events span chunks.
  Random random(4);
  const References many = boxes_on_a_lattice(100000, 8, random);
  const ExactPlanes finder(costs(), NoClipper());
  ExactPlanes::Scratch scratch;
  const KdPlane found = finder.find(ExactPlanes::make_set(many), cell_of(8.0F), scratch);
  expect_counts_of(many, found);
  double least = INFINITY;
  for (int axis = 0; axis < 3; ++axis)
    for (float position = 0.5F; position < 8.0F; position += 0.5F)
      for (const Side side : {Side::left, Side::right})
        if (is_inside(cell_of(8.0F), axis, position))
          least = std::min(least, counted_cost(many, cell_of(8.0F), {true, axis, position, side}, 0.2));
  EXPECT_NEAR(found.cost / least, 1.0, 1e-4);
}

TEST(BinnedPlanes, CountWhatIsOnTheSides) {
  Random random(5);
  const ReferenceClipper& clipper = NoClipper();
  for (const std::uint32_t count : {2U, 20U, 500U, 100000U}) {
    for (int trial = 0; trial < (count > 1000 ? 2 : 50); ++trial) {
      const References references = boxes_on_a_lattice(count, 16, random);
      const BinnedPlanes finder(costs(), clipper);
      BinnedPlanes::Scratch scratch;
      const KdPlane found = finder.find({references}, cell_of(17.0F), scratch);
      ASSERT_TRUE(found.is_possible);
      expect_counts_of(references, found);
      EXPECT_NEAR(found.cost / counted_cost(references, cell_of(17.0F), found, 0.2), 1.0, 1e-4);
    }
  }
}

TEST(MedianPlanes, HaveAsManyReferencesOnEitherSide) {
  const ReferenceClipper& clipper = NoClipper();
  for (const std::size_t count : {1U, 2U, 7U, 1000U, 100001U}) {
    const References references = list_references(testing::pebbles(count, 0.01F, 6)).references;
    const MedianPlanes finder(MedianPlanes::Of::objects, costs(), clipper);
    MedianPlanes::Scratch scratch;
    const Box4 cell{Float4{-1.0F, -1.0F, -2.0F, 0.0F}, Float4{2.0F, 2.0F, 2.0F, 0.0F}};
    const KdPlane found = finder.find({references}, cell, scratch);
    ASSERT_TRUE(found.is_possible);
    EXPECT_EQ(found.axis, 2);
    expect_counts_of(references, found);
    // The plane itself is an end, which belongs to one side.
    EXPECT_NEAR(found.lower_count, found.upper_count, 1.0);
  }
}

TEST(MedianPlanes, OfSpaceAreInTheMiddle) {
  const References references = list_references(testing::pebbles(50, 0.01F, 7)).references;
  const MedianPlanes finder(MedianPlanes::Of::space, costs(), NoClipper());
  MedianPlanes::Scratch scratch;
  const KdPlane found = finder.find({references}, {Float4{0.0F, -1.0F, 0.0F, 0.0F}, Float4{1.0F, 2.0F, 1.0F, 0.0F}}, scratch);
  EXPECT_EQ(found.axis, 1);
  EXPECT_EQ(found.position, 0.5F);
}

TEST(KdEvent, KeepsPositionsInOrder) {
  const float positions[] = {-INFINITY, -3e38F, -1.5F, -1e-42F, 0.0F, 1e-42F, 1.0F, 3e38F, INFINITY};
  for (std::size_t i = 0; i < std::size(positions); ++i) {
    const KdEvent event(positions[i], KdEvent::Kind::flat, 12345);
    EXPECT_EQ(event.position(), positions[i]);
    EXPECT_EQ(event.kind(), KdEvent::Kind::flat);
    EXPECT_EQ(event.reference(), 12345U);
    if (i > 0) {
      EXPECT_TRUE(KdEvent(positions[i - 1], KdEvent::Kind::begin, 99) < event);
    }
  }
  EXPECT_TRUE(KdEvent(-0.0F, KdEvent::Kind::end, 0).is_at_position_of(KdEvent(0.0F, KdEvent::Kind::begin, 1)));
}

}  // namespace
}  // namespace grove
