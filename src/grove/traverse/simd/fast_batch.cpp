#include "grove/traverse/simd/fast_batch.h"

#include "grove/base/error.h"

// Everything in HWY_NAMESPACE is compiled again for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "grove/traverse/simd/fast_batch.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "grove/traverse/simd/batch_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove {
namespace HWY_NAMESPACE {
namespace {

void run_batch(const BatchQuery& query, BatchMemory& memory) {
  if (query.results != nullptr) {
    query.counts != nullptr ? BatchKernel<true, true>(query, memory).run() : BatchKernel<true, false>(query, memory).run();
  } else {
    query.counts != nullptr ? BatchKernel<false, true>(query, memory).run() : BatchKernel<false, false>(query, memory).run();
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace grove
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grove {
namespace {

HWY_EXPORT(run_batch);

void run(const BatchQuery& query) {
  if (query.count == 0) return;
  BatchMemory memory(query.bvh);
  HWY_DYNAMIC_DISPATCH(run_batch)(query, memory);
}

}  // namespace

std::vector<std::string> batch_targets() {
  std::vector<std::string> names;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) names.emplace_back(hwy::TargetName(target));
  return names;
}

void force_batch_target(std::string_view name) {
  hwy::SetSupportedTargetsForTest(0);
  if (name.empty()) return;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    if (name != hwy::TargetName(target)) continue;
    hwy::SetSupportedTargetsForTest(target);
    return;
  }
  std::string allowed;
  for (const std::string& target : batch_targets()) allowed += (allowed.empty() ? "" : ", ") + target;
  throw UsageError("this machine has no instruction set '" + std::string(name) + "'; it has " + allowed);
}

void trace_closest(const FastBvh& bvh, std::span<const Ray> rays, std::span<Hit> hits, std::span<TraversalCounts> counts) {
  run({bvh, rays.data(), rays.size(), hits.data(), nullptr, counts.empty() ? nullptr : counts.data()});
}

void trace_any(const FastBvh& bvh, std::span<const Ray> rays, std::span<std::uint8_t> results, std::span<TraversalCounts> counts) {
  run({bvh, rays.data(), rays.size(), nullptr, results.data(), counts.empty() ? nullptr : counts.data()});
}

}  // namespace grove
#endif
