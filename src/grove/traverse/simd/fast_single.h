#pragma once

// One ray at a time through the hierarchy of the fast path, by the kernels of all instruction sets; fast_batch.h says how one is chosen.

#include "grove/accel/fast_bvh.h"
#include "grove/geometry/hit.h"
#include "grove/geometry/ray.h"
#include "grove/geometry/traversal_counts.h"

namespace grove {

/// Closest hit of a ray that is traceable. `hit.t` must start as the ray's t_max; what is found is what brute force finds, bit for bit. `counts`
/// is null, or what is counted is added to it. Any number of threads may call it.
void trace_single_closest(const FastBvh& bvh, const Ray& ray, Hit& hit, TraversalCounts* counts);

/// Whether anything is hit within [t_min, t_max]. Otherwise as trace_single_closest.
[[nodiscard]] bool trace_single_any(const FastBvh& bvh, const Ray& ray, TraversalCounts* counts);

}  // namespace grove
