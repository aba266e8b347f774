// Rays that stand side by side in a batch, set up together. Included once for each instruction set.

#if defined(GROVE_RAY_GROUP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_RAY_GROUP_INL_H
#undef GROVE_RAY_GROUP_INL_H
#else
#define GROVE_RAY_GROUP_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "grove/traverse/simd/batch_ray.h"
#include "grove/traverse/simd/ray_rows.h"
#include "grove/traverse/simd/ray_setup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Up to kMost rays of a batch; kMost is at most 64.
template <std::size_t kMost>
class RayGroup {
 public:
  explicit RayGroup(const Box& bounds) : setup_(bounds), most_way_(longest(bounds.upper - bounds.lower)) {}

  HWY_INLINE void prepare(const Ray* rays, std::size_t count) {
    rays_ = rays;
    count_ = count;
    regular_ = 0;
    is_by_ray_ = false;
    for (std::size_t first = 0; first < count; first += Setup::kCount)
      regular_ |= std::uint64_t{setup_.prepare(rays + first, std::min(Setup::kCount, count - first), rows_, first)} << first;
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  // Whether the kernels can take ray i, as RaySetup tells.
  [[nodiscard]] bool is_regular(std::size_t i) const { return (regular_ >> i & 1U) != 0; }
  [[nodiscard]] const RayRows<kMost>& rows() const { return rows_; }

  HWY_INLINE void copy(std::size_t i, BatchRay& ray) {
    if (!is_by_ray_) set_by_ray();
    const float* const parts[5] = {by_ray_[0][i], by_ray_[1][i], by_ray_[2][i], by_ray_[3][i], by_ray_[4][i]};
    ray.set(parts, rows_.octant[i], rows_.axes[i], rays_[i]);
  }

  // Whether `count` rays from number `first` on, both multiples of 32, may go side by side: they are there, the kernel can take all of them, their directions have
  // the same signs and are nearly the same, triangles are tested along the same axes for all, and they begin near each other, as those of a few pixels do.
  [[nodiscard]] bool is_packet(std::size_t first, std::size_t count) const {
    if (first + count > count_) return false;
    const std::uint64_t all = ~std::uint64_t{0} >> (64 - count) << first;
    if ((regular_ & all) != all || !are_same(rows_.octant + first, count) || !are_same(rows_.axes + first, count)) return false;
    const Ray& ray = rays_[first];
    const Vec3 most_turn(kMostSpread * longest(ray.direction));
    const Vec3 most_way(kMostSpread * most_way_);
    // Some stand for all: whoever is elsewhere costs time, not hits.
    for (std::size_t i = first + count / 4 - 1; i < first + count; i += count / 4) {
      if (glm::any(glm::greaterThan(glm::abs(rays_[i].direction - ray.direction), most_turn))) return false;
      if (glm::any(glm::greaterThan(glm::abs(rays_[i].origin - ray.origin), most_way))) return false;
    }
    return true;
  }

 private:
  using Setup = RaySetup<8>;
  static_assert(kMost % Setup::kCount == 0 && kMost <= 64);

  // By how much of the longest component of the first, and of the scene, rays may differ. Measured where packets begin to gain.
  static constexpr float kMostSpread = 1.0F / 12.0F;

  static float longest(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

  // Whether `count` numbers, a multiple of 8, are the same.
  static HWY_INLINE bool are_same(const std::uint32_t* numbers, std::size_t count) {
    const hn::CappedTag<std::uint32_t, 8> d;
    const auto first = hn::Set(d, numbers[0]);
    auto differences = hn::Zero(d);
    for (std::size_t i = 0; i < count; i += hn::MaxLanes(d)) differences = hn::Or(differences, hn::Xor(hn::LoadU(d, numbers + i), first));
    return hn::AllTrue(d, hn::Eq(differences, hn::Zero(d)));
  }

  // Writes the rows ray by ray, for those that go alone.
  HWY_NOINLINE void set_by_ray() {
    const hn::CappedTag<float, 8> d;
    const float(*const rows[5])[kMost] = {rows_.inverse, rows_.near_offset, rows_.far_offset, rows_.minus_origin_k, rows_.direction_k};
    for (int r = 0; r < 5; ++r) {
      for (std::size_t i = 0; i < count_; i += hn::MaxLanes(d)) {
        const auto load = [&](int k) { return hn::LoadU(d, rows[r][k] + i); };
        hn::StoreInterleaved4(load(0), load(1), load(2), load(3), d, by_ray_[r][i]);
      }
    }
    is_by_ray_ = true;
  }

  const Setup setup_;
  float most_way_;
  const Ray* rays_ = nullptr;
  std::size_t count_ = 0;
  std::uint64_t regular_ = 0;
  RayRows<kMost> rows_;
  bool is_by_ray_ = false;
  HWY_ALIGN float by_ray_[5][kMost][4];
};

}  // namespace HWY_NAMESPACE
}  // namespace grove
HWY_AFTER_NAMESPACE();

#endif
