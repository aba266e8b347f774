#include "grove/traverse/simd/fast_single.h"

// Everything in HWY_NAMESPACE is compiled again for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "grove/traverse/simd/compressed_single.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "grove/traverse/simd/single_ray-inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove {
namespace HWY_NAMESPACE {
namespace {

using Scene = FastScene<CompressedFastBvh>;

bool watertight_closest(const Scene& scene, const Ray& ray, Hit& hit) {
  return SingleRay<CompressedFastBvh, TriangleTest::watertight, false, false>::trace(scene, ray, hit, nullptr);
}

bool watertight_any(const Scene& scene, const Ray& ray, Hit& hit) {
  return SingleRay<CompressedFastBvh, TriangleTest::watertight, true, false>::trace(scene, ray, hit, nullptr);
}

bool fast_closest(const Scene& scene, const Ray& ray, Hit& hit) {
  return SingleRay<CompressedFastBvh, TriangleTest::fast, false, false>::trace(scene, ray, hit, nullptr);
}

bool fast_any(const Scene& scene, const Ray& ray, Hit& hit) {
  return SingleRay<CompressedFastBvh, TriangleTest::fast, true, false>::trace(scene, ray, hit, nullptr);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace grove
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grove {
namespace {

HWY_EXPORT(watertight_closest);
HWY_EXPORT(watertight_any);
HWY_EXPORT(fast_closest);
HWY_EXPORT(fast_any);

// Counting is for study: one instruction set is compiled.
template <TriangleTest kTest, bool kAny>
using Counting = HWY_NAMESPACE::SingleRay<CompressedFastBvh, kTest, kAny, true>;

}  // namespace

template <>
bool run_single_closest(const FastScene<CompressedFastBvh>& scene, TriangleTest test, const Ray& ray, Hit& hit, TraversalCounts* counts) {
  if (test == TriangleTest::fast)
    return counts == nullptr ? HWY_DYNAMIC_DISPATCH(fast_closest)(scene, ray, hit)
                             : Counting<TriangleTest::fast, false>::trace(scene, ray, hit, counts);
  return counts == nullptr ? HWY_DYNAMIC_DISPATCH(watertight_closest)(scene, ray, hit)
                           : Counting<TriangleTest::watertight, false>::trace(scene, ray, hit, counts);
}

template <>
bool run_single_any(const FastScene<CompressedFastBvh>& scene, TriangleTest test, const Ray& ray, Hit& hit, TraversalCounts* counts) {
  if (test == TriangleTest::fast)
    return counts == nullptr ? HWY_DYNAMIC_DISPATCH(fast_any)(scene, ray, hit)
                             : Counting<TriangleTest::fast, true>::trace(scene, ray, hit, counts);
  return counts == nullptr ? HWY_DYNAMIC_DISPATCH(watertight_any)(scene, ray, hit)
                           : Counting<TriangleTest::watertight, true>::trace(scene, ray, hit, counts);
}

}  // namespace grove
#endif
