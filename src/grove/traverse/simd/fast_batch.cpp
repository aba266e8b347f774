#include "grove/traverse/simd/fast_batch.h"

#include "grove/base/error.h"

// Everything in HWY_NAMESPACE is compiled again for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "grove/traverse/simd/fast_batch.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#undef GROVE_FAST_FORMAT
#define GROVE_FAST_FORMAT FastBvh
#include "grove/traverse/simd/batch_entry.inc"

#if HWY_ONCE
namespace grove {

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

}  // namespace grove
#endif
