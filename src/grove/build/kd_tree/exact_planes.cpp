#include "grove/build/kd_tree/exact_planes.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "grove/base/parallel.h"

namespace grove {
namespace {

// How many references have begun and ended before an event; flat ones do both.
struct Passed {
  std::uint32_t begun = 0;
  std::uint32_t ended = 0;

  void pass(KdEvent event) {
    begun += event.kind() != KdEvent::Kind::end ? 1 : 0;
    ended += event.kind() != KdEvent::Kind::begin ? 1 : 0;
  }
};

// One axis of one cell.
struct Sweep {
  const KdEvents& events;
  const Box4& cell;
  int axis;
  std::uint32_t total;
  const KdCellCost& cost;

  void consider(float position, std::uint32_t lower, std::uint32_t upper, Side side_of_flat, KdPlane& best) const {
    const float c = cost.of_plane(axis, position, lower, upper);
    if (c < best.cost) best = {true, axis, position, side_of_flat, c, lower, upper};
  }

  // The cheapest plane at events [first, last). Events of one position belong to where the first of them is.
  [[nodiscard]] KdPlane over(std::size_t first, std::size_t last, Passed passed) const {
    KdPlane best;
    std::size_t i = first;
    if (first > 0)
      for (; i < last && events[i].is_at_position_of(events[first - 1]); ++i) passed.pass(events[i]);
    while (i < last) {
      const KdEvent at = events[i];
      const Passed before = passed;
      std::uint32_t flat = 0;
      for (; i < events.size() && events[i].is_at_position_of(at); ++i) {
        passed.pass(events[i]);
        flat += events[i].kind() == KdEvent::Kind::flat ? 1 : 0;
      }
      const float position = at.position();
      if (!is_inside(cell, axis, position)) continue;
      const std::uint32_t upper = total - passed.ended;
      consider(position, before.begun + flat, upper, Side::left, best);
      if (flat > 0) consider(position, before.begun, upper + flat, Side::right, best);
    }
    return best;
  }
};

KdPlane find_in_parallel(const Sweep& sweep) {
  const std::size_t size = sweep.events.size();
  const std::size_t chunk_count = (size + kBuildChunkSize - 1) / kBuildChunkSize;
  std::vector<Passed> passed(chunk_count);
  parallel_chunks(size, kBuildChunkSize, [&](std::size_t id, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) passed[id].pass(sweep.events[i]);
  });
  Passed sum;
  for (Passed& chunk : passed) {
    sum.begun += std::exchange(chunk.begun, sum.begun);
    sum.ended += std::exchange(chunk.ended, sum.ended);
  }
  std::vector<KdPlane> planes(chunk_count);
  parallel_chunks(size, kBuildChunkSize,
                  [&](std::size_t id, std::size_t first, std::size_t last) { planes[id] = sweep.over(first, last, passed[id]); });
  // The first of equal cost.
  return *std::min_element(planes.begin(), planes.end(), [](const KdPlane& a, const KdPlane& b) { return a.cost < b.cost; });
}

}  // namespace

EventSet ExactPlanes::make_set(References references) {
  EventSet set;
  list_events(references, 0, set.events.data());
  set.references = std::move(references);
  return set;
}

KdPlane ExactPlanes::find(const Set& set, const Box4& cell, Scratch& /*scratch*/) const {
  const KdCellCost cost = costs_.of(cell);
  const auto total = static_cast<std::uint32_t>(set.references.size());
  KdPlane planes[3];
  parallel_for(3, total > kKdParallelSize ? 1 : 3, [&](std::size_t i) {
    const int axis = static_cast<int>(i);
    if (!(cell.lower[axis] < cell.upper[axis])) return;
    const Sweep sweep{set.events[i], cell, axis, total, cost};
    planes[i] = total > kKdParallelSize ? find_in_parallel(sweep) : sweep.over(0, set.events[i].size(), {});
  });
  return *std::min_element(planes, planes + 3, [](const KdPlane& a, const KdPlane& b) { return a.cost < b.cost; });
}

void ExactPlanes::part(const Set& set, const KdPlane& plane, Set* const sides[2], Scratch& scratch) const {
  References* const references[2] = {&sides[0]->references, &sides[1]->references};
  part_references(set.references, plane, clipper_, references, TrackPlaces::yes, scratch);
  const References* const parted_references[2] = {references[0], references[1]};
  KdEvents* const parted[2] = {sides[0]->events.data(), sides[1]->events.data()};
  part_events(set.events.data(), scratch.places, parted_references, parted, scratch.events);
}

}  // namespace grove
