#pragma once

// How a structure's leaves reach the primitives: by slot, the position in its list of references. Every storage has `resize`, `refresh`, `prefetch`,
// `intersect` and `occluded` by slot; which one a geometry uses is LeafStorage<G>.

#include <cstdint>
#include <span>

#include "grove/base/huge_vector.h"
#include "grove/base/parallel.h"
#include "grove/geometry/geometry_concept.h"
#include "grove/geometry/primitive_test.h"
#include "grove/geometry/triangle_mesh.h"
#include "grove/math/float4.h"

namespace grove {

/// Looks each primitive up in its geometry. Costs no memory; right where a test is dear anyway.
template <Geometry G>
class IndirectLeaves {
 public:
  IndirectLeaves(const G& /*geometry*/, std::span<const std::uint32_t> /*references*/) {}

  [[nodiscard]] static std::size_t memory() { return 0; }

  /// Makes room for so many slots; those that are new must be refreshed.
  static void resize(std::size_t /*slot_count*/) {}

  /// Bounds of the primitives in slots [first, first + count) as they are now. `all_hittable` becomes false when one can never be hit.
  [[nodiscard]] Box4 refresh(const G& geometry, const std::uint32_t* references, std::uint32_t first, std::uint32_t count,
                             bool& all_hittable) {
    Box4 bounds = Box4::empty();
    for (std::uint32_t slot = first; slot < first + count; ++slot) {
      const Box box = geometry.bounds(references[slot]);
      if (box.is_empty()) all_hittable = false;
      bounds.grow(Box4{to_float4(box.lower), to_float4(box.upper)});
    }
    return bounds;
  }

  void prefetch(const std::uint32_t* references, std::uint32_t slot) const { __builtin_prefetch(references + slot); }

  template <typename C>
  bool intersect(const G& geometry, const std::uint32_t* references, std::uint32_t slot, const typename G::PreparedRay& ray, Hit& hit,
                 C& counter) const {
    return intersect_primitive(geometry, references[slot], ray, hit, counter);
  }

  template <typename C>
  bool occluded(const G& geometry, const std::uint32_t* references, std::uint32_t slot, const typename G::PreparedRay& ray,
                C& counter) const {
    return occluded_primitive(geometry, references[slot], ray, counter);
  }
};

/// Keeps the corners of each referenced triangle in leaf order: one stretch of memory instead of a chain of three look-ups (reference,
/// indices, vertices), which cost an incoherent ray more than the test itself. 36 bytes a reference.
class PackedTriangleLeaves {
 public:
  PackedTriangleLeaves(const TriangleMesh& mesh, std::span<const std::uint32_t> references) : corners_(references.size() + 1) {
    const std::span<const Vec3> vertices = mesh.vertices();
    const std::span<const Triangle> triangles = mesh.triangles();
    parallel_for(references.size(), 16384, [&](std::size_t slot) {
      const Triangle& triangle = triangles[references[slot]];
      corners_[slot] = TriangleCorners(vertices[triangle.x], vertices[triangle.y], vertices[triangle.z]);
    });
  }

  [[nodiscard]] std::size_t memory() const { return corners_.size() * sizeof(TriangleCorners); }

  void resize(std::size_t slot_count) { corners_.resize(slot_count + 1); }

  /// As IndirectLeaves::refresh; fetches the corners again.
  [[nodiscard]] Box4 refresh(const TriangleMesh& mesh, const std::uint32_t* references, std::uint32_t first, std::uint32_t count,
                             bool& all_hittable) {
    const std::span<const Vec3> vertices = mesh.vertices();
    const std::span<const Triangle> triangles = mesh.triangles();
    Box4 bounds = Box4::empty();
    for (std::uint32_t slot = first; slot < first + count; ++slot) {
      const Triangle& triangle = triangles[references[slot]];
      if (mesh.is_removed(references[slot])) all_hittable = false;
      const Vec3 corners[3] = {vertices[triangle.x], vertices[triangle.y], vertices[triangle.z]};
      for (const Vec3& corner : corners) {
        if (!Ray::is_within(corner, kMaxCoordinate)) all_hittable = false;
        bounds.grow(to_float4(corner));
      }
      corners_[slot] = TriangleCorners(corners[0], corners[1], corners[2]);
    }
    return bounds;
  }

  void prefetch(const std::uint32_t* /*references*/, std::uint32_t slot) const { __builtin_prefetch(corners_.data() + slot); }

  template <typename C>
  bool intersect(const TriangleMesh& /*mesh*/, const std::uint32_t* references, std::uint32_t slot, const WatertightRay& ray, Hit& hit,
                 C& counter) const {
    return take_if_accepted(counter, hit, [&](Hit& taken) { return intersect_watertight(ray, corners_[slot], references + slot, taken); });
  }

  template <typename C>
  bool occluded(const TriangleMesh& mesh, const std::uint32_t* references, std::uint32_t slot, const WatertightRay& ray, C& counter) const {
    if constexpr (FiltersHits<C>) {
      Hit hit;
      hit.t = ray.ray.t_max;
      return intersect(mesh, references, slot, ray, hit, counter);
    }
    return occluded_watertight(ray, corners_[slot]);
  }

 private:
  HugeVector<TriangleCorners> corners_;  // and one more, for the room that loading the last one takes
};

namespace detail {

template <Geometry G>
struct LeafStorageOf {
  using Type = IndirectLeaves<G>;
};
template <>
struct LeafStorageOf<TriangleMesh> {
  using Type = PackedTriangleLeaves;
};

}  // namespace detail

/// The storage that measures best for a geometry.
template <Geometry G>
using LeafStorage = typename detail::LeafStorageOf<G>::Type;

}  // namespace grove
