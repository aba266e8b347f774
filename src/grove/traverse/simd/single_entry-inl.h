// The entry to the kernels for single rays of one format, which is named by GROVE_FAST_FORMAT: a source for each, so that they are compiled side by side.
// Included once for each instruction set.

#if defined(GROVE_SINGLE_ENTRY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_SINGLE_ENTRY_INL_H
#undef GROVE_SINGLE_ENTRY_INL_H
#else
#define GROVE_SINGLE_ENTRY_INL_H
#endif

#include "grove/traverse/simd/fast_single.h"
#include "grove/traverse/simd/single_ray-inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove {
namespace HWY_NAMESPACE {
namespace {

using Scene = FastScene<GROVE_FAST_FORMAT>;

bool watertight_closest(const Scene& scene, const Ray& ray, Hit& hit) {
  return SingleRay<GROVE_FAST_FORMAT, TriangleTest::watertight, false, false>::trace(scene, ray, hit, nullptr);
}

bool watertight_any(const Scene& scene, const Ray& ray, Hit& hit) {
  return SingleRay<GROVE_FAST_FORMAT, TriangleTest::watertight, true, false>::trace(scene, ray, hit, nullptr);
}

bool fast_closest(const Scene& scene, const Ray& ray, Hit& hit) {
  return SingleRay<GROVE_FAST_FORMAT, TriangleTest::fast, false, false>::trace(scene, ray, hit, nullptr);
}

bool fast_any(const Scene& scene, const Ray& ray, Hit& hit) {
  return SingleRay<GROVE_FAST_FORMAT, TriangleTest::fast, true, false>::trace(scene, ray, hit, nullptr);
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
using Counting = HWY_NAMESPACE::SingleRay<GROVE_FAST_FORMAT, kTest, kAny, true>;

}  // namespace

template <>
bool run_single_closest(const FastScene<GROVE_FAST_FORMAT>& scene, TriangleTest test, const Ray& ray, Hit& hit, TraversalCounts* counts) {
  if (test == TriangleTest::fast)
    return counts == nullptr ? HWY_DYNAMIC_DISPATCH(fast_closest)(scene, ray, hit)
                             : Counting<TriangleTest::fast, false>::trace(scene, ray, hit, counts);
  return counts == nullptr ? HWY_DYNAMIC_DISPATCH(watertight_closest)(scene, ray, hit)
                           : Counting<TriangleTest::watertight, false>::trace(scene, ray, hit, counts);
}

template <>
bool run_single_any(const FastScene<GROVE_FAST_FORMAT>& scene, TriangleTest test, const Ray& ray, Hit& hit, TraversalCounts* counts) {
  if (test == TriangleTest::fast)
    return counts == nullptr ? HWY_DYNAMIC_DISPATCH(fast_any)(scene, ray, hit)
                             : Counting<TriangleTest::fast, true>::trace(scene, ray, hit, counts);
  return counts == nullptr ? HWY_DYNAMIC_DISPATCH(watertight_any)(scene, ray, hit)
                           : Counting<TriangleTest::watertight, true>::trace(scene, ray, hit, counts);
}

}  // namespace grove
#endif

#endif
