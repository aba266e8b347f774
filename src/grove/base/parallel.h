#pragma once

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>
#include <oneapi/tbb/parallel_sort.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace grove {

/// Calls `body(first, last)` on consecutive pieces of [0, count), in parallel in the caller's oneTBB arena.
/// Piece borders depend on the scheduler: use it where the result does not depend on them.
template <typename Body>
void parallel_ranges(std::size_t count, std::size_t grain, const Body& body) {
  if (count <= grain) {
    if (count > 0) body(std::size_t{0}, count);
    return;
  }
  oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, count, grain),
                            [&](const oneapi::tbb::blocked_range<std::size_t>& range) { body(range.begin(), range.end()); });
}

/// Calls `body(i)` for each i in [0, count), in parallel in the caller's oneTBB arena.
template <typename Body>
void parallel_for(std::size_t count, std::size_t grain, const Body& body) {
  parallel_ranges(count, grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) body(i);
  });
}

/// Splits [0, count) into chunks of exactly `chunk` items (the last may be shorter) and calls `body(chunk_id, first, last)` for
/// each in parallel. The borders do not depend on the number of threads, so per-chunk results joined in order are deterministic.
template <typename Body>
void parallel_chunks(std::size_t count, std::size_t chunk, const Body& body) {
  const std::size_t chunk_count = (count + chunk - 1) / chunk;
  parallel_for(chunk_count, 1, [&](std::size_t id) {
    const std::size_t first = id * chunk;
    body(id, first, std::min(count, first + chunk));
  });
}

/// Runs two functions, possibly at the same time, and returns when both are done.
template <typename First, typename Second>
void parallel_invoke(const First& first, const Second& second) {
  oneapi::tbb::parallel_invoke(first, second);
}

/// Sorts a std::vector or HugeVector whose items all differ under `less`, so that the result does not depend on the number of threads.
template <typename T, typename Allocator, typename Less>
void parallel_sort(std::vector<T, Allocator>& items, const Less& less) {
  oneapi::tbb::parallel_sort(items.begin(), items.end(), less);
}

}  // namespace grove
