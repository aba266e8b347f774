// The entry to the batch kernels of one format, which is named by GROVE_FAST_FORMAT: a source for each, so that they are compiled side by side. Included
// once for each instruction set.

#if defined(GROVE_BATCH_ENTRY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_BATCH_ENTRY_INL_H
#undef GROVE_BATCH_ENTRY_INL_H
#else
#define GROVE_BATCH_ENTRY_INL_H
#endif

#include "grove/traverse/simd/batch_run-inl.h"
#include "grove/traverse/simd/fast_batch.h"

HWY_BEFORE_NAMESPACE();
namespace grove {
namespace HWY_NAMESPACE {
namespace {

void run_watertight(const BatchQuery<GROVE_FAST_FORMAT>& query, BatchMemory& memory) {
  run_batch<GROVE_FAST_FORMAT, TriangleTest::watertight, false>(query, memory);
}

void run_fast(const BatchQuery<GROVE_FAST_FORMAT>& query, BatchMemory& memory) {
  run_batch<GROVE_FAST_FORMAT, TriangleTest::fast, false>(query, memory);
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
void trace_batch(const BatchQuery<GROVE_FAST_FORMAT>& query, TriangleTest test) {
  if (query.count == 0) return;
  BatchMemory memory(query.scene.bvh.depth);
  const bool is_watertight = test == TriangleTest::watertight;
  if (query.counts != nullptr) {
    // Counting is for study, and counts are the same on every instruction set but for the rounding of box tests: one is compiled.
    is_watertight ? HWY_NAMESPACE::run_batch<GROVE_FAST_FORMAT, TriangleTest::watertight, true>(query, memory)
                  : HWY_NAMESPACE::run_batch<GROVE_FAST_FORMAT, TriangleTest::fast, true>(query, memory);
  } else {
    is_watertight ? HWY_DYNAMIC_DISPATCH(run_watertight)(query, memory) : HWY_DYNAMIC_DISPATCH(run_fast)(query, memory);
  }
}

}  // namespace grove
#endif

#endif
