#include "grove/build/kd_tree/event_list.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "grove/base/parallel.h"

namespace grove {
namespace {

void list_events_along(const References& references, std::size_t first, std::size_t last, int axis, KdEvents& events) {
  events.resize(2 * (last - first));
  KdEvent* next = events.data();
  for (std::size_t i = first; i < last; ++i) {
    const auto id = static_cast<std::uint32_t>(i);
    const float lower = references[i].lower[axis];
    const float upper = references[i].upper[axis];
    if (lower == upper) {
      *next++ = {lower, KdEvent::Kind::flat, id};
      continue;
    }
    *next++ = {lower, KdEvent::Kind::begin, id};
    *next++ = {upper, KdEvent::Kind::end, id};
  }
  events.resize(static_cast<std::size_t>(next - events.data()));
}

// Copies the events of whole references to their sides and returns how many went to each.
struct SideCounts {
  std::size_t count[2] = {0, 0};
};
SideCounts filter(std::span<const KdEvent> events, const KdPlaces& places, KdEvent* const out[2]) {
  SideCounts counts;
  for (const KdEvent event : events) {
    const KdPlace place = places.of[event.reference()];
    if (!place.is_whole()) continue;
    const int side = place.side();
    out[side][counts.count[side]++] = event.renumbered(place.place());
  }
  return counts;
}

void part_serially(const KdEvents& events, const KdPlaces& places, const KdEvents* const of_pieces[2], KdEvents* const parted[2]) {
  KdEvent* out[2];
  for (int s = 0; s < 2; ++s) {
    parted[s]->resize(2 * std::size_t{places.whole_count[s]} + of_pieces[s]->size());
    // Leaves room in front: merging towards the front never overtakes what it reads.
    out[s] = parted[s]->data() + of_pieces[s]->size();
  }
  const SideCounts kept = filter(events, places, out);
  for (int s = 0; s < 2; ++s) {
    KdEvent* next = parted[s]->data();
    const KdEvent* whole = out[s];
    const KdEvent* const whole_end = whole + kept.count[s];
    for (const KdEvent piece : *of_pieces[s]) {
      while (whole != whole_end && *whole < piece) *next++ = *whole++;
      *next++ = piece;
    }
    parted[s]->resize(kept.count[s] + of_pieces[s]->size());
  }
}

// A stretch of the old events along one axis, and what it became.
struct Chunk {
  KdEvents kept[2];
  // Of the events of pieces, those that go before the end of this stretch.
  std::size_t pieces_end[2] = {0, 0};
};

void part_in_parallel(const KdEvents events[3], const KdPlaces& places, const EventScratch& scratch, KdEvents* const parted[2]) {
  std::size_t first_chunk[4] = {0, 0, 0, 0};
  for (int axis = 0; axis < 3; ++axis)
    first_chunk[axis + 1] = first_chunk[axis] + (events[axis].size() + kBuildChunkSize - 1) / kBuildChunkSize;
  std::vector<Chunk> chunks(first_chunk[3]);
  const auto axis_of = [&](std::size_t id) { return id < first_chunk[1] ? 0 : id < first_chunk[2] ? 1 : 2; };
  parallel_for(chunks.size(), 1, [&](std::size_t id) {
    const int axis = axis_of(id);
    const std::size_t first = (id - first_chunk[axis]) * kBuildChunkSize;
    const std::span<const KdEvent> stretch(events[axis].data() + first, std::min(kBuildChunkSize, events[axis].size() - first));
    KdEvent* out[2];
    for (int s = 0; s < 2; ++s) {
      chunks[id].kept[s].resize(stretch.size());
      out[s] = chunks[id].kept[s].data();
    }
    const SideCounts counts = filter(stretch, places, out);
    for (int s = 0; s < 2; ++s) {
      chunks[id].kept[s].resize(counts.count[s]);
      const KdEvents& pieces = scratch.of_pieces[s][axis];
      const bool is_last = id + 1 == first_chunk[axis + 1];
      // By position and kind alone, since numbers have changed; equal events may go in any order.
      const auto end = is_last ? pieces.end() : std::lower_bound(pieces.begin(), pieces.end(), stretch.back().renumbered(0));
      chunks[id].pieces_end[s] = static_cast<std::size_t>(end - pieces.begin());
    }
  });
  struct Place {
    std::size_t out, pieces_first;
  };
  std::vector<Place> begin[2];
  for (int s = 0; s < 2; ++s) {
    begin[s].resize(chunks.size());
    for (int axis = 0; axis < 3; ++axis) {
      Place next{0, 0};
      for (std::size_t id = first_chunk[axis]; id < first_chunk[axis + 1]; ++id) {
        begin[s][id] = next;
        next.out += chunks[id].kept[s].size() + chunks[id].pieces_end[s] - next.pieces_first;
        next.pieces_first = chunks[id].pieces_end[s];
      }
      parted[s][axis].resize(next.out);
    }
  }
  parallel_for(2 * chunks.size(), 1, [&](std::size_t i) {
    const std::size_t id = i / 2;
    const std::size_t s = i % 2;
    const int axis = axis_of(id);
    const KdEvent* const pieces = scratch.of_pieces[s][axis].data();
    std::merge(chunks[id].kept[s].begin(), chunks[id].kept[s].end(), pieces + begin[s][id].pieces_first, pieces + chunks[id].pieces_end[s],
               parted[s][axis].begin() + static_cast<std::ptrdiff_t>(begin[s][id].out));
  });
}

}  // namespace

void list_events(const References& references, std::size_t first, KdEvents events[3]) {
  const std::size_t last = references.size();
  if (last - first <= kBuildChunkSize) {
    for (int axis = 0; axis < 3; ++axis) {
      list_events_along(references, first, last, axis, events[axis]);
      std::sort(events[axis].begin(), events[axis].end());
    }
    return;
  }
  parallel_for(3, 1, [&](std::size_t axis) {
    list_events_along(references, first, last, static_cast<int>(axis), events[axis]);
    parallel_sort(events[axis], std::less<>());
  });
}

void part_events(const KdEvents events[3], const KdPlaces& places, const References* const sides[2], KdEvents* const parted[2],
                 EventScratch& scratch) {
  for (int s = 0; s < 2; ++s) list_events(*sides[s], places.whole_count[s], scratch.of_pieces[s]);
  if (places.of.size() > kKdParallelSize) {
    part_in_parallel(events, places, scratch, parted);
    return;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const KdEvents* const of_pieces[2] = {&scratch.of_pieces[0][axis], &scratch.of_pieces[1][axis]};
    KdEvents* const of_axis[2] = {&parted[0][axis], &parted[1][axis]};
    part_serially(events[axis], places, of_pieces, of_axis);
  }
}

}  // namespace grove
