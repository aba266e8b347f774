#pragma once

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <cstring>

#include "grove/accel/bvh2.h"

namespace grove::testing {

/// What `work` returns when so many threads take part, also where the machine has fewer.
template <typename Work>
auto with_threads(int threads, const Work& work) {
  const oneapi::tbb::global_control allowed(oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  return oneapi::tbb::task_arena(threads).execute(work);
}

/// Bit for bit.
inline bool same_hierarchy(const Bvh2& a, const Bvh2& b) {
  return a.nodes.size() == b.nodes.size() && a.references == b.references && a.depth == b.depth &&
         std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(Bvh2Node)) == 0;
}

}  // namespace grove::testing
