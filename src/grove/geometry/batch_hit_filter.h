#pragma once

// A say in the hits of many rays that are traced together.

#include <cstddef>

#include "grove/geometry/hit_filter.h"

namespace grove {

/// Which hits of the rays of one batch count: as HitFilter, and `accept` is told the ray by its number in the batch as well. It is asked from the thread that
/// traces the batch, about its rays in turns.
class BatchHitFilter {
 public:
  using Accept = bool (*)(void* context, std::size_t ray, const Hit& hit);

  BatchHitFilter(Accept accept, void* context) : accept_(accept), context_(context) {}

  [[nodiscard]] bool operator()(std::size_t ray, const Hit& hit) const { return accept_(context_, ray, hit); }

 private:
  Accept accept_;
  void* context_;
};

/// What the filter of a batch says of one of its rays.
class FilterOfOneRay {
 public:
  FilterOfOneRay(const BatchHitFilter& batch, std::size_t ray) : batch_(batch), ray_(ray) {}

  [[nodiscard]] bool operator()(const Hit& hit) const { return batch_(ray_, hit); }
  [[nodiscard]] HitFilter filter() { return {accept, this}; }

 private:
  static bool accept(void* context, const Hit& hit) { return (*static_cast<const FilterOfOneRay*>(context))(hit); }

  BatchHitFilter batch_;
  std::size_t ray_;
};

/// A batch's filter for a traversal that knows primitives by their numbers in the whole of `geometry`, which it refers to.
template <typename G>
class LocatingFilter {
 public:
  LocatingFilter(const BatchHitFilter& outer, const G& geometry) : outer_(outer), geometry_(&geometry) {}

  [[nodiscard]] BatchHitFilter filter() { return {accept, this}; }

 private:
  static bool accept(void* context, std::size_t ray, const Hit& hit) {
    const auto& self = *static_cast<const LocatingFilter*>(context);
    Hit whole = hit;
    self.geometry_->locate(whole);
    return self.outer_(ray, whole);
  }

  BatchHitFilter outer_;
  const G* geometry_;
};

}  // namespace grove
