#pragma once

// Many rays at once through the hierarchy of the fast path: some dozens are in flight in one thread, so that one ray's cache misses and branch
// mispredictions are hidden behind the arithmetic of others. The kernels are written once and compiled for each instruction set of the processor
// family; which one runs is chosen at run time.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "grove/geometry/hit.h"
#include "grove/geometry/ray.h"
#include "grove/geometry/traversal_counts.h"
#include "grove/traverse/fast_traversal.h"
#include "grove/traverse/simd/batch_slot.h"
#include "grove/traverse/simd/triangle_test.h"

namespace grove {

/// Runs a batch by the best kernel that this machine has. `Bvh` is FastBvh or CompressedFastBvh.
template <typename Bvh>
void trace_batch(const BatchQuery<Bvh>& query, TriangleTest test);
template <>
void trace_batch(const BatchQuery<FastBvh>& query, TriangleTest test);
template <>
void trace_batch(const BatchQuery<CompressedFastBvh>& query, TriangleTest test);

/// Closest hits: with TriangleTest::watertight hits[i] is what brute force finds for rays[i], bit for bit, with `primitive` as the blocks have it; t is
/// infinite on a miss. `counts` is empty, or as long as the others and overwritten. Any number of threads may call it. Throws std::bad_alloc.
template <typename Bvh>
void trace_closest(const FastScene<Bvh>& scene, TriangleTest test, std::span<const Ray> rays, std::span<Hit> hits,
                   std::span<TraversalCounts> counts) {
  trace_batch<Bvh>({scene, rays.data(), rays.size(), hits.data(), nullptr, counts.empty() ? nullptr : counts.data()}, test);
}

/// Whether anything is hit within [t_min, t_max]: results[i] is 1 or 0. Otherwise as trace_closest.
template <typename Bvh>
void trace_any(const FastScene<Bvh>& scene, TriangleTest test, std::span<const Ray> rays, std::span<std::uint8_t> results,
               std::span<TraversalCounts> counts) {
  trace_batch<Bvh>({scene, rays.data(), rays.size(), nullptr, results.data(), counts.empty() ? nullptr : counts.data()}, test);
}

/// The same among the hits that `filter` accepts, which is told `primitive` as blocks have it.
template <typename Bvh>
void trace_closest(const FastScene<Bvh>& scene, TriangleTest test, std::span<const Ray> rays, std::span<Hit> hits,
                   const BatchHitFilter& filter) {
  trace_batch<Bvh>({scene, rays.data(), rays.size(), hits.data(), nullptr, nullptr, &filter}, test);
}
template <typename Bvh>
void trace_any(const FastScene<Bvh>& scene, TriangleTest test, std::span<const Ray> rays, std::span<std::uint8_t> results,
               const BatchHitFilter& filter) {
  trace_batch<Bvh>({scene, rays.data(), rays.size(), nullptr, results.data(), nullptr, &filter}, test);
}

/// The instruction sets that the kernels are compiled for and this machine has, best first, by Highway's names: AVX3 is AVX-512.
[[nodiscard]] std::vector<std::string> batch_targets();

/// Makes all batches from now on use one of batch_targets(), or with an empty name the best. For tests and comparisons: it must not be called while
/// rays are traced. Throws UsageError that lists what there is.
void force_batch_target(std::string_view name);

}  // namespace grove
