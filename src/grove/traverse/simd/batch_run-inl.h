// Runs one batch by the kernel of an instruction set. Included once for each of them.

#if defined(GROVE_BATCH_RUN_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_BATCH_RUN_INL_H
#undef GROVE_BATCH_RUN_INL_H
#else
#define GROVE_BATCH_RUN_INL_H
#endif

#include "grove/traverse/simd/batch_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove {
namespace HWY_NAMESPACE {

template <typename Bvh, TriangleTest kTest, Beside kBeside>
void run_batch(const BatchQuery<Bvh>& query, BatchMemory& memory) {
  if (query.results != nullptr) {
    BatchKernel<Bvh, kTest, true, kBeside>(query, memory).run();
  } else {
    BatchKernel<Bvh, kTest, false, kBeside>(query, memory).run();
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace grove
HWY_AFTER_NAMESPACE();

#endif
