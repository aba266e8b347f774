#pragma once

// One ray at a time through the hierarchy of the fast path, by the kernels of all instruction sets; fast_batch.h says how one is chosen.

#include "grove/geometry/hit.h"
#include "grove/geometry/hit_filter.h"
#include "grove/geometry/ray.h"
#include "grove/geometry/traversal_counts.h"
#include "grove/traverse/fast_traversal.h"
#include "grove/traverse/simd/triangle_test.h"

namespace grove {

/// Traces a ray by the best kernel that this machine has; `hit.t` is its t_max. Returns false where the ray's numbers or the depth of the hierarchy
/// are out of the kernels' range. `Bvh` is FastBvh or CompressedFastBvh.
template <typename Bvh>
bool run_single_closest(const FastScene<Bvh>& scene, TriangleTest test, const Ray& ray, Hit& hit, TraversalCounts* counts);
template <>
bool run_single_closest(const FastScene<FastBvh>& scene, TriangleTest test, const Ray& ray, Hit& hit, TraversalCounts* counts);
template <>
bool run_single_closest(const FastScene<CompressedFastBvh>& scene, TriangleTest test, const Ray& ray, Hit& hit, TraversalCounts* counts);
/// The same for any hit, whose primitive is 0.
template <typename Bvh>
bool run_single_any(const FastScene<Bvh>& scene, TriangleTest test, const Ray& ray, Hit& hit, TraversalCounts* counts);
template <>
bool run_single_any(const FastScene<FastBvh>& scene, TriangleTest test, const Ray& ray, Hit& hit, TraversalCounts* counts);
template <>
bool run_single_any(const FastScene<CompressedFastBvh>& scene, TriangleTest test, const Ray& ray, Hit& hit, TraversalCounts* counts);

/// The same among the hits that `filter` accepts, which is told `primitive` as blocks have it. Of any hit the primitive is whichever was accepted.
template <typename Bvh>
bool run_filtered_closest(const FastScene<Bvh>& scene, TriangleTest test, const Ray& ray, Hit& hit, const HitFilter& filter);
template <>
bool run_filtered_closest(const FastScene<FastBvh>& scene, TriangleTest test, const Ray& ray, Hit& hit, const HitFilter& filter);
template <>
bool run_filtered_closest(const FastScene<CompressedFastBvh>& scene, TriangleTest test, const Ray& ray, Hit& hit, const HitFilter& filter);
template <typename Bvh>
bool run_filtered_any(const FastScene<Bvh>& scene, TriangleTest test, const Ray& ray, Hit& hit, const HitFilter& filter);
template <>
bool run_filtered_any(const FastScene<FastBvh>& scene, TriangleTest test, const Ray& ray, Hit& hit, const HitFilter& filter);
template <>
bool run_filtered_any(const FastScene<CompressedFastBvh>& scene, TriangleTest test, const Ray& ray, Hit& hit, const HitFilter& filter);

/// Closest hit of a ray that is traceable. `hit.t` must start as the ray's t_max; with TriangleTest::watertight what is found is what brute force finds,
/// bit for bit. `counts` is null, or what is counted is added to it. Any number of threads may call it.
template <typename Bvh>
void trace_single_closest(const FastScene<Bvh>& scene, TriangleTest test, const Ray& ray, Hit& hit, TraversalCounts* counts) {
  if (scene.bvh.empty() || run_single_closest(scene, test, ray, hit, counts)) return;
  if (counts == nullptr) {
    NoCounter counter;
    trace_closest(scene, ray, hit, counter);
  } else {
    Counter counter(*counts);
    trace_closest(scene, ray, hit, counter);
  }
}

/// Whether anything is hit within [t_min, t_max]. Otherwise as trace_single_closest.
template <typename Bvh>
[[nodiscard]] bool trace_single_any(const FastScene<Bvh>& scene, TriangleTest test, const Ray& ray, TraversalCounts* counts) {
  if (scene.bvh.empty()) return false;
  Hit hit;
  hit.t = ray.t_max;
  if (run_single_any(scene, test, ray, hit, counts)) return static_cast<bool>(hit);
  if (counts == nullptr) {
    NoCounter counter;
    return trace_any(scene, ray, counter);
  }
  Counter counter(*counts);
  return trace_any(scene, ray, counter);
}

/// Closest hit of a ray that is traceable, among those that `filter` accepts, which is told `primitive` as blocks have it. Otherwise as trace_single_closest.
template <typename Bvh>
void trace_filtered_closest(const FastScene<Bvh>& scene, TriangleTest test, const Ray& ray, Hit& hit, const HitFilter& filter) {
  if (scene.bvh.empty() || run_filtered_closest(scene, test, ray, hit, filter)) return;
  BlockFilterCounter counter(filter);
  trace_closest(scene, ray, hit, counter);
}

/// Whether there is any. Otherwise as trace_filtered_closest.
template <typename Bvh>
[[nodiscard]] bool trace_filtered_any(const FastScene<Bvh>& scene, TriangleTest test, const Ray& ray, const HitFilter& filter) {
  if (scene.bvh.empty()) return false;
  Hit hit;
  hit.t = ray.t_max;
  if (run_filtered_any(scene, test, ray, hit, filter)) return static_cast<bool>(hit);
  BlockFilterCounter counter(filter);
  return trace_any(scene, ray, counter);
}

}  // namespace grove
