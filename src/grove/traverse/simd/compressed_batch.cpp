// Everything in HWY_NAMESPACE is compiled again for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "grove/traverse/simd/compressed_batch.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#undef GROVE_FAST_FORMAT
#define GROVE_FAST_FORMAT CompressedFastBvh
#include "grove/traverse/simd/batch_entry.inc"
