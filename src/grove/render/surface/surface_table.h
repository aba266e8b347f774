#pragma once

#include <cstdint>
#include <vector>

#include "grove/render/surface/surface_point.h"
#include "grove/scene/scene.h"

namespace grove {

/// What hits of a scene lie on, laid out for quick look-up. Refers to the scene; any number of threads may use it.
class SurfaceTable {
 public:
  explicit SurfaceTable(const Scene& scene);

  /// The point that `ray` met. O(1).
  [[nodiscard]] SurfacePoint at(const Ray& ray, const Hit& hit) const;

  /// The same numbers as those of that point, without the rest of it. O(1).
  [[nodiscard]] SurfaceCoordinates coordinates_at(const Hit& hit) const;

  /// Asks memory for what `at` will read of a hit, in two steps that are to lie some work apart: the second reads what the first asked for.
  void prefetch_primitive(const Hit& hit) const;
  void prefetch_corners(const Hit& hit) const;

  /// The point of a triangle at barycentrics (u, v), without a ray.
  [[nodiscard]] SurfacePoint on_triangle(std::uint32_t instance, std::uint32_t geometry, std::uint32_t primitive, const Vec2& uv) const;
  /// The point of a sphere whose object-space normal is `normal`.
  [[nodiscard]] SurfacePoint on_sphere(std::uint32_t instance, std::uint32_t geometry, std::uint32_t primitive, const Vec3& normal) const;

  /// The material of what was hit.
  [[nodiscard]] std::uint32_t material_of(const Hit& hit) const;

 private:
  struct InstanceView {
    std::uint32_t first_part;  // in parts_
    bool is_identity;
    bool is_mirrored;
    const Transform* transform;
  };
  struct PartView {
    const Part* part;
    const TriangleMesh* mesh;  // or null
    const SphereSet* spheres;  // or null
    std::uint32_t first_primitive;
    std::uint32_t first_vertex;
  };

  [[nodiscard]] const PartView& part_of(const Hit& hit) const {
    return parts_[instances_[hit.instance == kInvalidId ? 0 : hit.instance].first_part + hit.geometry];
  }
  [[nodiscard]] SurfacePoint triangle_point(const InstanceView& instance, const PartView& part, std::uint32_t primitive,
                                            const Vec2& barycentric) const;
  [[nodiscard]] SurfacePoint sphere_point(const InstanceView& instance, const PartView& part, std::uint32_t primitive, const Vec3& normal,
                                          const Vec2& uv) const;
  static void to_world(const InstanceView& instance, float object_magnitude, SurfacePoint& point);

  std::vector<InstanceView> instances_;
  std::vector<PartView> parts_;
};

}  // namespace grove
