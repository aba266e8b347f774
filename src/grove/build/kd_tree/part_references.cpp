#include "grove/build/kd_tree/part_references.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "grove/base/parallel.h"

namespace grove {
namespace {

constexpr int kSides = 3;  // lower, upper, across

int index_of(Side side) {
  return side == Side::left ? 0 : side == Side::right ? 1 : 2;
}

// Where the next reference of each kind goes.
struct Cursor {
  std::uint32_t next[kSides] = {0, 0, 0};
};

// Halves of a reference that reaches across.
PrimitiveReference below(PrimitiveReference reference, const KdPlane& plane) {
  reference.upper[plane.axis] = plane.position;
  return reference;
}
PrimitiveReference above(PrimitiveReference reference, const KdPlane& plane) {
  reference.lower[plane.axis] = plane.position;
  return reference;
}

Cursor count(const References& references, const KdPlane& plane, std::size_t first, std::size_t last) {
  Cursor cursor;
  for (std::size_t i = first; i < last; ++i) ++cursor.next[index_of(plane.side(references[i]))];
  return cursor;
}

void place(const References& references, const KdPlane& plane, std::size_t first, std::size_t last, Cursor cursor,
           References* const side[2], TrackPlaces track, PartScratch& scratch) {
  for (std::size_t i = first; i < last; ++i) {
    const PrimitiveReference& reference = references[i];
    const int kind = index_of(plane.side(reference));
    const std::uint32_t at = cursor.next[kind]++;
    if (kind == 2) {
      scratch.pieces[0][at] = below(reference, plane);
      scratch.pieces[1][at] = above(reference, plane);
    } else {
      (*side[kind])[at] = reference;
    }
    if (track == TrackPlaces::yes) scratch.places.of[i] = {kind == 2 ? KdPlace::kInPieces : at << 1U | static_cast<std::uint32_t>(kind)};
  }
}

void append_pieces(References* const side[2], PartScratch& scratch, const KdPlane& plane, const ReferenceClipper& clipper) {
  const std::size_t count = scratch.pieces[0].size();
  const std::size_t chunk = 1024;
  parallel_chunks(count, chunk, [&](std::size_t /*id*/, std::size_t first, std::size_t last) {
    for (int s = 0; s < 2; ++s) clipper.clip({scratch.pieces[s].data() + first, last - first});
  });
  for (int s = 0; s < 2; ++s) side[s]->reserve(side[s]->size() + count);
  for (std::size_t i = 0; i < count; ++i) {
    bool is_kept = false;
    for (int s = 0; s < 2; ++s) {
      if (is_outside(scratch.pieces[s][i])) continue;
      side[s]->push_back(scratch.pieces[s][i]);
      is_kept = true;
    }
    if (is_kept) continue;
    // Rounding of the clip: a primitive that only just touches the cell. It stays, as if it lay in the plane.
    Box box{scratch.pieces[0][i].box().box().lower, scratch.pieces[1][i].box().box().upper};
    box.lower[plane.axis] = box.upper[plane.axis] = plane.position;
    side[0]->push_back(make_reference(box, scratch.pieces[0][i].primitive()));
  }
}

}  // namespace

void part_references(const References& references, const KdPlane& plane, const ReferenceClipper& clipper, References* const side[2],
                     TrackPlaces track, PartScratch& scratch) {
  const std::size_t size = references.size();
  const std::size_t chunk_size = size > kKdParallelSize ? kBuildChunkSize : std::max<std::size_t>(size, 1);
  Cursor total;
  std::vector<Cursor> chunks;
  if (size > chunk_size) {
    chunks.resize((size + chunk_size - 1) / chunk_size);
    parallel_chunks(size, chunk_size,
                    [&](std::size_t id, std::size_t first, std::size_t last) { chunks[id] = count(references, plane, first, last); });
    for (Cursor& chunk : chunks)
      for (int kind = 0; kind < kSides; ++kind) total.next[kind] += std::exchange(chunk.next[kind], total.next[kind]);
  } else {
    total = count(references, plane, 0, size);
  }
  for (int s = 0; s < 2; ++s) {
    side[s]->resize(total.next[s]);
    scratch.pieces[s].resize(total.next[2]);
    scratch.places.whole_count[s] = total.next[s];
  }
  if (track == TrackPlaces::yes) scratch.places.of.resize(size);
  parallel_chunks(size, chunk_size, [&](std::size_t id, std::size_t first, std::size_t last) {
    place(references, plane, first, last, chunks.empty() ? Cursor() : chunks[id], side, track, scratch);
  });
  append_pieces(side, scratch, plane, clipper);
}

}  // namespace grove
