#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "grove/registry/accelerator.h"

namespace grove {

/// What is asked of each ray.
enum class Query : std::uint8_t { closest, any };

[[nodiscard]] std::string_view name_of(Query query);

/// Traces all rays, in batches, in parallel in the caller's oneTBB arena; hits[i] answers rays[i], and the spans must be of equal length.
/// An any-hit query sets t to 0 where the ray is occluded and leaves all else as in a miss.
void trace(const Accelerator& accelerator, Query query, std::span<const Ray> rays, std::span<Hit> hits);

/// The same, and sets counts[i] to what ray i did.
void trace_counted(const Accelerator& accelerator, Query query, std::span<const Ray> rays, std::span<Hit> hits,
                   std::span<TraversalCounts> counts);

/// The same, and returns the sum of what all rays did.
TraversalCounts trace_counted(const Accelerator& accelerator, Query query, std::span<const Ray> rays, std::span<Hit> hits);

}  // namespace grove
