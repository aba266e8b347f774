#include "grove/traverse/simd/fast_batch.h"

// Everything in HWY_NAMESPACE is compiled again for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "grove/traverse/simd/compressed_batch.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "grove/traverse/simd/batch_run-inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove {
namespace HWY_NAMESPACE {
namespace {

void run_watertight(const BatchQuery<CompressedFastBvh>& query, BatchMemory& memory) {
  run_batch<CompressedFastBvh, TriangleTest::watertight, false>(query, memory);
}

void run_fast(const BatchQuery<CompressedFastBvh>& query, BatchMemory& memory) {
  run_batch<CompressedFastBvh, TriangleTest::fast, false>(query, memory);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace grove
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grove {
namespace {

HWY_EXPORT(run_watertight);
HWY_EXPORT(run_fast);

}  // namespace

template <>
void trace_batch(const BatchQuery<CompressedFastBvh>& query, TriangleTest test) {
  if (query.count == 0) return;
  BatchMemory memory(query.scene.bvh.depth);
  const bool is_watertight = test == TriangleTest::watertight;
  if (query.counts != nullptr) {
    // Counting is for study, and counts are the same on every instruction set but for the rounding of box tests: one is compiled.
    is_watertight ? HWY_NAMESPACE::run_batch<CompressedFastBvh, TriangleTest::watertight, true>(query, memory)
                  : HWY_NAMESPACE::run_batch<CompressedFastBvh, TriangleTest::fast, true>(query, memory);
  } else {
    is_watertight ? HWY_DYNAMIC_DISPATCH(run_watertight)(query, memory) : HWY_DYNAMIC_DISPATCH(run_fast)(query, memory);
  }
}

}  // namespace grove
#endif
