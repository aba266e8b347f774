#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "grove/geometry/hit.h"
#include "grove/geometry/ray.h"
#include "grove/math/box.h"

namespace grove {

/// Analytic spheres, in one or more parts as TriangleMesh has them. A sphere is hollow: a ray that starts inside hits its far side.
/// Spheres with a radius that is not positive and finite, or a centre that is not finite, can never be hit. A set changes as a mesh does: numbers
/// stay, and structures over it must be updated.
class SphereSet {
 public:
  struct Sphere {
    Vec3 centre{0.0F};
    float radius = 1.0F;
  };

  /// The ray with the doubles that every test needs.
  struct PreparedRay {
    Ray ray;
    double inverse_length_squared = 0.0;
  };

  SphereSet() = default;
  explicit SphereSet(std::vector<Sphere> spheres);

  /// Appends a part and returns its number.
  std::uint32_t add_part(std::vector<Sphere> spheres);

  /// Appends spheres to the last part, which there must be. Returns the number of the first in the whole set.
  std::uint32_t extend_last_part(std::span<const Sphere> spheres);

  /// Makes sphere i one that can never be hit: its radius becomes 0.
  void remove_sphere(std::size_t i) { spheres_[i].radius = 0.0F; }

  /// Replaces every sphere, over all parts. Throws InputError when there are not as many as size().
  void move_spheres(std::vector<Sphere> spheres);
  /// Replaces one.
  void move_sphere(std::size_t i, const Sphere& sphere) { spheres_[i] = sphere; }

  [[nodiscard]] std::size_t size() const { return spheres_.size(); }
  [[nodiscard]] std::size_t part_count() const { return part_first_.size(); }
  [[nodiscard]] const Sphere& sphere(std::size_t i) const { return spheres_[i]; }
  [[nodiscard]] std::uint32_t first_sphere(std::uint32_t part) const { return part_first_[part]; }

  [[nodiscard]] Box bounds(std::size_t i) const;
  /// Bounds of the sphere's surface inside `box`, conservative: the box intersection, or empty when the surface misses the box.
  [[nodiscard]] Box clip(std::size_t i, const Box& box) const;
  /// Whether the sphere's surface shares a point with the closed box (Arvo 1990), conservative.
  [[nodiscard]] bool overlaps(std::size_t i, const Box& box) const { return !clip(i, box).is_empty(); }

  /// As SampledGeometry asks.
  [[nodiscard]] double surface_area(std::size_t i) const;
  [[nodiscard]] glm::dvec3 surface_point(std::size_t i, double u, double v) const;

  [[nodiscard]] static PreparedRay prepare(const Ray& ray);
  template <typename Counter>
  bool intersect(std::size_t i, const PreparedRay& ray, Hit& hit, Counter& /*counter*/) const {
    return intersect(i, ray, hit);
  }
  template <typename Counter>
  bool occluded(std::size_t i, const PreparedRay& ray, Counter& /*counter*/) const {
    return occluded(i, ray);
  }

  void locate(Hit& hit) const;

 private:
  static void check_size(std::size_t size);
  bool intersect(std::size_t i, const PreparedRay& ray, Hit& hit) const;
  [[nodiscard]] bool occluded(std::size_t i, const PreparedRay& ray) const;

  std::vector<Sphere> spheres_;
  std::vector<std::uint32_t> part_first_;
};

}  // namespace grove
