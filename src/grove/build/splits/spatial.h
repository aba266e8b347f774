#pragma once

// Spatial splits: Stich, Friedrich, Dietrich, "Spatial Splits in Bounding Volume Hierarchies" (2009). Besides the binned object split, planes
// are tried that cut through primitives: a reference that straddles the plane is divided into two, each with the bounds of its part of the
// primitive. Where keeping it whole on one side costs less, it stays whole (reference unsplitting, section 4.4 of the paper). Spatial splits
// are tried only where the object split's sides overlap much (section 4.5), and while the range's share of the duplication budget lasts.
//
// Differences from the paper: whether a reference is unsplit is decided from the split's boxes before any has been unsplit, and not
// one after another, so that the decision depends on the reference alone and can be made in parallel.

#include <cstdint>
#include <span>

#include "grove/build/splits/binned.h"
#include "grove/build/splits/slices.h"
#include "grove/build/splits/spatial_bins.h"
#include "grove/geometry/geometry_concept.h"

namespace grove {

/// Either an object split, or a plane.
struct SpatialSplit : Split {
  bool is_spatial = false;
  bool unsplits = false;
  BinnedSplit object;
  int axis = 0;
  float plane = 0.0F;
  float area_scale = 1.0F;
  /// The sides before unsplitting: boxes, and the times of their counts and of one reference less.
  Box4 whole_left;
  Box4 whole_right;
  float left_time[2];
  float right_time[2];

  [[nodiscard]] Side side(const PrimitiveReference& reference) const {
    if (!is_spatial) return object.side(reference);
    if (reference.lower[axis] >= plane) return Side::right;
    if (reference.upper[axis] <= plane) return Side::left;
    return unsplits ? cheapest_side(reference) : Side::both;
  }

 private:
  [[nodiscard]] Side cheapest_side(const PrimitiveReference& reference) const;
};

/// The cheapest plane over all axes, before unsplitting; impossible where it needs more than `slack` further references.
[[nodiscard]] SpatialSplit find_spatial_split(const SpatialBins& bins, const SpatialGrid grids[3], std::uint32_t count, std::uint32_t slack,
                                              const SplitContext& context);

/// A reference with the bounds `box`, which it must have for it to be kept: outside of it there is none of the primitive.
[[nodiscard]] PrimitiveReference with_box(const PrimitiveReference& reference, const Box& box);

/// The part of `box` on one side of a plane.
[[nodiscard]] inline Box below(Box box, int axis, float plane) {
  box.upper[axis] = plane < box.upper[axis] ? plane : box.upper[axis];
  return box;
}
[[nodiscard]] inline Box above(Box box, int axis, float plane) {
  box.lower[axis] = plane > box.lower[axis] ? plane : box.lower[axis];
  return box;
}

/// The heuristic; `geometry` clips its primitives and must outlive it.
template <Geometry G>
class SpatialHeuristic {
 public:
  using Split = SpatialSplit;
  struct Scratch {
    Bins object;
    SpatialBins spatial;
  };
  static constexpr bool kDividesReferences = true;

  /// Spatial splits are tried where the sides of the object split overlap by more than `least_overlap`, a half area in scaled units, and by more
  /// than the share `least_overlap_of_range` of the range's half area.
  SpatialHeuristic(const SplitContext& context, const G& geometry, float least_overlap, float least_overlap_of_range)
      : objects_(context), geometry_(geometry), least_overlap_(least_overlap), least_overlap_of_range_(least_overlap_of_range) {}
  [[nodiscard]] const SplitContext& context() const { return objects_.context(); }

  [[nodiscard]] SpatialSplit find(const ReferenceRange& range, std::span<const PrimitiveReference> references, Scratch& scratch) const {
    SpatialSplit split = object_split(objects_.find(range, references, scratch.object));
    if (!is_worth_trying(range, split)) return split;
    const SpatialGrid grids[3] = {{range.bounds, 0}, {range.bounds, 1}, {range.bounds, 2}};
    scratch.spatial.clear();
    add(scratch.spatial, range.bounds, grids, references);
    choose_spatial(split, scratch.spatial, grids, range, references, references.size());
    return split;
  }

  [[nodiscard]] SpatialSplit find_in_parallel(const ReferenceRange& range, std::span<const PrimitiveReference> references) const {
    SpatialSplit split = object_split(objects_.find_in_parallel(range, references));
    if (!is_worth_trying(range, split)) return split;
    const SpatialGrid grids[3] = {{range.bounds, 0}, {range.bounds, 1}, {range.bounds, 2}};
    std::vector<SpatialBins> bins((references.size() + kBuildChunkSize - 1) / kBuildChunkSize);
    parallel_chunks(references.size(), kBuildChunkSize, [&](std::size_t chunk, std::size_t first, std::size_t last) {
      bins[chunk].clear();
      add(bins[chunk], range.bounds, grids, references.subspan(first, last - first));
    });
    for (std::size_t chunk = 1; chunk < bins.size(); ++chunk) bins[0].merge(bins[chunk]);
    choose_spatial(split, bins[0], grids, range, references, kBuildChunkSize);
    return split;
  }

  /// The parts of `whole` on both sides of the split's plane.
  void divide(const SpatialSplit& split, const PrimitiveReference& whole, PrimitiveReference& left, PrimitiveReference& right) const {
    const Box box = whole.box().box();
    left = with_box(whole, clip_or_keep(whole.primitive(), below(box, split.axis, split.plane)));
    right = with_box(whole, clip_or_keep(whole.primitive(), above(box, split.axis, split.plane)));
  }

 private:
  static SpatialSplit object_split(const BinnedSplit& object) {
    SpatialSplit split;
    static_cast<grove::Split&>(split) = object;
    split.object = object;
    return split;
  }

  [[nodiscard]] bool is_worth_trying(const ReferenceRange& range, const SpatialSplit& split) const {
    if (range.slack() == 0) return false;
    if (!split.is_possible) return true;
    const Box4 overlap{max(split.left.lower, split.right.lower), min(split.left.upper, split.right.upper)};
    if (first_three_lanes(overlap.lower <= overlap.upper) != 7) return false;
    const float area = scaled_half_area(overlap, context().area_scale);
    return area > least_overlap_ && area > least_overlap_of_range_ * scaled_half_area(range.bounds, context().area_scale);
  }

  // A part that clipping finds empty, by a rounding, keeps the box it was clipped to: a reference without a box would be lost.
  [[nodiscard]] Box clip_or_keep(std::uint32_t primitive, const Box& box) const {
    const Box clipped = geometry_.clip(primitive, box);
    return clipped.is_empty() ? box : clipped;
  }

  void add(SpatialBins& bins, const Box4& bounds, const SpatialGrid grids[3], std::span<const PrimitiveReference> references) const {
    const SpatialGrids all(bounds, grids);
    for (const PrimitiveReference& reference : references) {
      const Box4 whole = reference.box();
      Int4 bin;
      const int is_single = first_three_lanes(all.single_bins(whole, bin));
      for (int axis = 0; axis < 3; ++axis) {
        if ((is_single >> axis & 1) != 0) {
          ++bins.begin[axis][bin[axis]];
          ++bins.end[axis][bin[axis]];
          bins.box[axis][bin[axis]].grow(whole);
          continue;
        }
        const SpatialGrid& grid = grids[axis];
        if (!grid.is_usable()) continue;
        const int first = grid.first_bin(whole.lower[axis]);
        const int last = grid.last_bin(whole.upper[axis], first);
        ++bins.begin[axis][first];
        ++bins.end[axis][last];
        if (first == last) {
          bins.box[axis][first].grow(whole);
          continue;
        }
        add_slices(geometry_, reference.primitive(), whole, grid, axis, first, last, bins.box[axis]);
      }
    }
  }

  // Replaces `split` by the best spatial one where that costs less, with the counts and boxes that unsplitting leaves.
  void choose_spatial(SpatialSplit& split, const SpatialBins& bins, const SpatialGrid grids[3], const ReferenceRange& range,
                      std::span<const PrimitiveReference> references, std::size_t chunk_size) const {
    SpatialSplit spatial = find_spatial_split(bins, grids, range.count, range.slack(), context());
    if (!spatial.is_possible || (split.is_possible && split.cost <= spatial.cost)) return;
    settle(spatial, references, chunk_size);
    if (spatial.left_count == 0 || spatial.right_count == 0) {
      spatial.unsplits = false;
      settle(spatial, references, chunk_size);
    }
    split = spatial;
  }

  // Counts and boxes of both sides as they will be after parting.
  void settle(SpatialSplit& split, std::span<const PrimitiveReference> references, std::size_t chunk_size) const {
    struct Sides {
      Box4 box[2] = {Box4::empty(), Box4::empty()};
      std::uint32_t count[2] = {0, 0};
    };
    std::vector<Sides> chunks((references.size() + chunk_size - 1) / chunk_size);
    parallel_chunks(references.size(), chunk_size, [&](std::size_t chunk, std::size_t first, std::size_t last) {
      Sides sides;
      for (std::size_t i = first; i < last; ++i) {
        const Side side = split.side(references[i]);
        PrimitiveReference pieces[2] = {references[i], references[i]};
        if (side == Side::both) divide(split, references[i], pieces[0], pieces[1]);
        if (side != Side::right) {
          sides.box[0].grow(pieces[0].box());
          ++sides.count[0];
        }
        if (side != Side::left) {
          sides.box[1].grow(pieces[1].box());
          ++sides.count[1];
        }
      }
      chunks[chunk] = sides;
    });
    split.left = Box4::empty();
    split.right = Box4::empty();
    split.left_count = 0;
    split.right_count = 0;
    for (const Sides& sides : chunks) {
      split.left.grow(sides.box[0]);
      split.right.grow(sides.box[1]);
      split.left_count += sides.count[0];
      split.right_count += sides.count[1];
    }
    split.cost = scaled_half_area(split.left, context().area_scale) * context().time(split.left_count) +
                 scaled_half_area(split.right, context().area_scale) * context().time(split.right_count);
  }

  BinnedHeuristic objects_;
  const G& geometry_;
  float least_overlap_;
  float least_overlap_of_range_;
};

}  // namespace grove
