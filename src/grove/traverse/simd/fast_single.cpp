#include "grove/traverse/simd/fast_single.h"

// Everything in HWY_NAMESPACE is compiled again for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "grove/traverse/simd/fast_single.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "grove/traverse/simd/single_ray-inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove {
namespace HWY_NAMESPACE {
namespace {

bool single_closest(const FastBvh& bvh, const Ray& ray, Hit& hit) {
  return SingleRay<false, false>::trace(bvh, ray, hit, nullptr);
}

bool single_any(const FastBvh& bvh, const Ray& ray, Hit& hit) {
  return SingleRay<true, false>::trace(bvh, ray, hit, nullptr);
}

bool single_closest_counted(const FastBvh& bvh, const Ray& ray, Hit& hit, TraversalCounts* counts) {
  return SingleRay<false, true>::trace(bvh, ray, hit, counts);
}

bool single_any_counted(const FastBvh& bvh, const Ray& ray, Hit& hit, TraversalCounts* counts) {
  return SingleRay<true, true>::trace(bvh, ray, hit, counts);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace grove
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grove {
namespace {

HWY_EXPORT(single_closest);
HWY_EXPORT(single_any);
HWY_EXPORT(single_closest_counted);
HWY_EXPORT(single_any_counted);

}  // namespace

void trace_single_closest(const FastBvh& bvh, const Ray& ray, Hit& hit, TraversalCounts* counts) {
  if (bvh.empty()) return;
  if (counts == nullptr) {
    if (HWY_DYNAMIC_DISPATCH(single_closest)(bvh, ray, hit)) return;
    NoCounter counter;
    trace_closest(bvh, ray, hit, counter);
  } else {
    if (HWY_DYNAMIC_DISPATCH(single_closest_counted)(bvh, ray, hit, counts)) return;
    Counter counter(*counts);
    trace_closest(bvh, ray, hit, counter);
  }
}

bool trace_single_any(const FastBvh& bvh, const Ray& ray, TraversalCounts* counts) {
  if (bvh.empty()) return false;
  Hit hit;
  hit.t = ray.t_max;
  if (counts == nullptr) {
    if (HWY_DYNAMIC_DISPATCH(single_any)(bvh, ray, hit)) return static_cast<bool>(hit);
    NoCounter counter;
    return trace_any(bvh, ray, counter);
  }
  if (HWY_DYNAMIC_DISPATCH(single_any_counted)(bvh, ray, hit, counts)) return static_cast<bool>(hit);
  Counter counter(*counts);
  return trace_any(bvh, ray, counter);
}

}  // namespace grove
#endif
