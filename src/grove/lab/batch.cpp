#include "grove/lab/batch.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "grove/base/check.h"
#include "grove/base/parallel.h"

namespace grove {
namespace {

/// Rays handed over at once: enough to make the virtual call vanish, few enough that rays and hits stay in the first two cache levels.
constexpr std::size_t kBatchSize = 1024;

void trace_batch(const Accelerator& accelerator, Query query, std::span<const Ray> rays, std::span<Hit> hits,
                 std::span<TraversalCounts> counts) {
  if (query == Query::closest) {
    accelerator.intersect(rays, hits, counts);
    return;
  }
  std::array<std::uint8_t, kBatchSize> occluded{};
  accelerator.occluded(rays, std::span(occluded).first(rays.size()), counts);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    hits[i] = Hit{};
    hits[i].t = occluded[i] != 0 ? 0.0F : std::numeric_limits<float>::infinity();
  }
}

}  // namespace

std::string_view name_of(Query query) {
  return query == Query::closest ? "closest" : "any";
}

void trace(const Accelerator& accelerator, Query query, std::span<const Ray> rays, std::span<Hit> hits) {
  GROVE_CHECK(rays.size() == hits.size());
  parallel_chunks(rays.size(), kBatchSize, [&](std::size_t /*chunk*/, std::size_t first, std::size_t last) {
    trace_batch(accelerator, query, rays.subspan(first, last - first), hits.subspan(first, last - first), {});
  });
}

void trace_counted(const Accelerator& accelerator, Query query, std::span<const Ray> rays, std::span<Hit> hits,
                   std::span<TraversalCounts> counts) {
  GROVE_CHECK(rays.size() == hits.size() && rays.size() == counts.size());
  parallel_chunks(rays.size(), kBatchSize, [&](std::size_t /*chunk*/, std::size_t first, std::size_t last) {
    const std::size_t count = last - first;
    trace_batch(accelerator, query, rays.subspan(first, count), hits.subspan(first, count), counts.subspan(first, count));
  });
}

TraversalCounts trace_counted(const Accelerator& accelerator, Query query, std::span<const Ray> rays, std::span<Hit> hits) {
  GROVE_CHECK(rays.size() == hits.size());
  std::vector<TraversalCounts> sums((rays.size() + kBatchSize - 1) / kBatchSize);
  parallel_chunks(rays.size(), kBatchSize, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    std::vector<TraversalCounts> counts(last - first);
    trace_batch(accelerator, query, rays.subspan(first, last - first), hits.subspan(first, last - first), counts);
    for (const TraversalCounts& count : counts) sums[chunk] += count;
  });
  TraversalCounts total;
  for (const TraversalCounts& sum : sums) total += sum;
  return total;
}

}  // namespace grove
