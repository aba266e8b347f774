#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "grove/geometry/hit.h"
#include "grove/geometry/ray.h"
#include "grove/math/box.h"

namespace grove {

/// Primitives of the program's own: boxes, and a function that tells where a ray meets one.
///
/// Derive, override `size`, `bounds` and `intersect_primitive`, and hand a shared_ptr to `build`. All functions may be called by many
/// threads at once and must not throw.
class UserGeometry {
 public:
  using PreparedRay = Ray;

  virtual ~UserGeometry() = default;

  [[nodiscard]] virtual std::size_t size() const = 0;

  /// Must enclose every point that `intersect_primitive` reports. Empty for a primitive that is never hit.
  [[nodiscard]] virtual Box bounds(std::size_t i) const = 0;

  /// Where `ray` first meets primitive i with t in [ray.t_min, ray.t_max]: sets t, u and v of `hit` (nothing else) and returns true; or
  /// returns false and leaves `hit`. Must give the same answer for the same ray, whatever ray.t_max is, as long as t is inside.
  [[nodiscard]] virtual bool intersect_primitive(std::size_t i, const Ray& ray, Hit& hit) const = 0;

  /// So many primitives are asked about in one call at most.
  static constexpr std::size_t kMostAtOnce = 8;

  /// `intersect_primitive` for each of up to kMostAtOnce primitives, those of a leaf of a hierarchy: bit k of the result tells whether primitives[k] is met, and
  /// hits[k] where. What is here calls it for each; override it where a virtual call a primitive is dear, or several can be tested at once. Hierarchies
  /// call it once a leaf for rays without a filter; the others, and rays with one, ask about one primitive at a time.
  [[nodiscard]] virtual std::uint32_t intersect_primitives(std::span<const std::uint32_t> primitives, const Ray& ray, Hit* hits) const;

  [[nodiscard]] Box clip(std::size_t i, const Box& box) const { return bounds(i).intersection(box); }
  [[nodiscard]] bool overlaps(std::size_t i, const Box& box) const { return !clip(i, box).is_empty(); }
  [[nodiscard]] static PreparedRay prepare(const Ray& ray) { return ray; }

  template <typename Counter>
  bool intersect(std::size_t i, const PreparedRay& ray, Hit& hit, Counter& /*counter*/) const {
    return intersect_closer(i, ray, hit);
  }
  template <typename Counter>
  bool occluded(std::size_t i, const PreparedRay& ray, Counter& /*counter*/) const {
    Hit hit;
    hit.t = ray.t_max;
    return intersect_closer(i, ray, hit);
  }
  /// The closest hit of `ray` among primitives, those of a leaf; `hit` is the closest so far and is replaced when there is a closer one.
  void intersect_leaf(std::span<const std::uint32_t> primitives, const PreparedRay& ray, Hit& hit) const;
  void locate(Hit& hit) const { hit.geometry = hit ? 0 : kInvalidId; }

 private:
  static bool take_closer(const Hit& candidate, std::uint32_t primitive, const Ray& ray, Hit& hit);
  bool intersect_closer(std::size_t i, const Ray& ray, Hit& hit) const;
};

}  // namespace grove
