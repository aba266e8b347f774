#pragma once

#include <cstdint>

#include "grove/base/huge_vector.h"
#include "grove/build/kd_tree/kd_plane.h"
#include "grove/build/kd_tree/reference_clipper.h"

namespace grove {

using References = HugeVector<PrimitiveReference>;

/// Where a reference of a set went: which side, and its place in that side's set. None where it is in pieces.
struct KdPlace {
  std::uint32_t code;  ///< place * 2 + side

  static constexpr std::uint32_t kInPieces = 0xffffffffU;
  [[nodiscard]] bool is_whole() const { return code != kInPieces; }
  [[nodiscard]] int side() const { return static_cast<int>(code & 1U); }
  [[nodiscard]] std::uint32_t place() const { return code >> 1U; }
};

/// Places of all references of a set. In each side's set, pieces follow the whole references, from whole_count on.
struct KdPlaces {
  HugeVector<KdPlace> of;
  std::uint32_t whole_count[2] = {0, 0};
};

/// Memory that parting uses, kept from one cell to the next.
struct PartScratch {
  References pieces[2];
  KdPlaces places;
};

/// Parts a set by a plane into `side[0]` (lower) and `side[1]`, whatever they held. Those that reach across are cut at the plane and clipped; a piece of
/// which nothing is left is dropped, but never both. Fills scratch.places.of where `track` says so. In parallel for large sets; the same for any number of threads.
enum class TrackPlaces : std::uint8_t { no, yes };
void part_references(const References& references, const KdPlane& plane, const ReferenceClipper& clipper, References* const side[2],
                     TrackPlaces track, PartScratch& scratch);

}  // namespace grove
