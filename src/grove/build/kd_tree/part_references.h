#pragma once

#include <cstdint>

#include "grove/base/huge_vector.h"
#include "grove/build/kd_tree/kd_plane.h"
#include "grove/build/kd_tree/reference_clipper.h"

namespace grove {

using References = HugeVector<PrimitiveReference>;

/// The place of a reference that is not on a side whole.
inline constexpr std::uint32_t kNoPlace = 0xffffffffU;

/// Which references of a set went where: place[0][i] in the lower set, place[1][i] in the upper one, kNoPlace where not or in pieces. The pieces follow
/// the whole references in each set, from whole_count on.
struct KdPlaces {
  HugeVector<std::uint32_t> place[2];
  std::uint32_t whole_count[2] = {0, 0};
};

/// Memory that parting uses, kept from one cell to the next.
struct PartScratch {
  References pieces[2];
  KdPlaces places;
};

/// Parts a set by a plane into `side[0]` (lower) and `side[1]`, whatever they held. Those that reach across are cut at the plane and clipped; a piece of
/// which nothing is left is dropped, but never both. Fills scratch.places where `track` says so. In parallel for large sets; the same for any number of threads.
enum class TrackPlaces : std::uint8_t { no, yes };
void part_references(const References& references, const KdPlane& plane, const ReferenceClipper& clipper, References* const side[2],
                     TrackPlaces track, PartScratch& scratch);

}  // namespace grove
