// Rays that stand side by side in a batch, set up together. Included once for each instruction set.

#if defined(GROVE_RAY_GROUP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GROVE_RAY_GROUP_INL_H
#undef GROVE_RAY_GROUP_INL_H
#else
#define GROVE_RAY_GROUP_INL_H
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "grove/traverse/simd/batch_ray.h"
#include "grove/traverse/simd/ray_setup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove {
namespace HWY_NAMESPACE {

// Up to kMost rays of a batch.
template <std::size_t kMost>
class RayGroup {
 public:
  using Setup = RaySetup<8>;
  static constexpr std::size_t kSetups = (kMost + Setup::kCount - 1) / Setup::kCount;

  explicit RayGroup(const Box& bounds)
      : setups_(make_setups(bounds, std::make_index_sequence<kSetups>())), most_way_(longest(bounds.upper - bounds.lower)) {}

  HWY_INLINE void prepare(const Ray* rays, std::size_t count) {
    rays_ = rays;
    count_ = count;
    for (std::size_t first = 0; first < count; first += Setup::kCount)
      setups_[first / Setup::kCount].prepare(rays + first, std::min(Setup::kCount, count - first));
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  // As of RaySetup.
  [[nodiscard]] bool is_regular(std::size_t i) const { return setups_[i / Setup::kCount].is_regular(i % Setup::kCount); }
  HWY_INLINE void copy(std::size_t i, BatchRay& ray) const { setups_[i / Setup::kCount].copy(i % Setup::kCount, ray); }
  [[nodiscard]] const Setup& setup(std::size_t number) const { return setups_[number]; }

  // Whether `count` rays from number `first` on, both multiples of Setup::kCount and of 4, may go side by side: they are there, the kernel can take all of them,
  // their directions have the same signs and are nearly the same, triangles are tested along the same axes for all, and they begin near each other, as those
  // of a few pixels do.
  [[nodiscard]] bool is_packet(std::size_t first, std::size_t count) const {
    if (first + count > count_) return false;
    const Setup& front = setups_[first / Setup::kCount];
    for (std::size_t i = first; i < first + count; i += Setup::kCount) {
      const Setup& setup = setups_[i / Setup::kCount];
      if (!setup.is_regular() || !setup.has_one_octant() || setup.octant(0) != front.octant(0)) return false;
      if (!setup.has_one_kind_of_axes() || setup.axes(0) != front.axes(0)) return false;
    }
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
  // By how much of the longest component of the first, and of the scene, rays may differ. Measured where packets begin to gain.
  static constexpr float kMostSpread = 1.0F / 12.0F;

  static float longest(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

  template <std::size_t... kNumbers>
  static std::array<Setup, kSetups> make_setups(const Box& bounds, std::index_sequence<kNumbers...> /*numbers*/) {
    return {((void)kNumbers, Setup(bounds))...};
  }

  std::array<Setup, kSetups> setups_;
  float most_way_;
  const Ray* rays_ = nullptr;
  std::size_t count_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace grove
HWY_AFTER_NAMESPACE();

#endif
