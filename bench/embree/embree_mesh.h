#pragma once

// What every contender does with Embree alike: a mesh becomes a scene, rays and hits are carried over.

#include <embree3/rtcore.h>

#include <cstdint>
#include <span>

#include "grove/geometry/hit.h"
#include "grove/geometry/ray.h"
#include "grove/geometry/triangle_mesh.h"

namespace grove::bench {

/// A scene of one mesh with all that can be done before rtcCommitScene, which builds. Released by the caller; the mesh's triangles must outlive it.
[[nodiscard]] RTCScene new_mesh_scene(RTCDevice device, const TriangleMesh& mesh, RTCBuildQuality quality, bool is_robust);

[[nodiscard]] RTCRay to_embree(const Ray& ray);

/// From Embree's numbers, in the order in which a ray and its hit have them; nothing for RTC_INVALID_GEOMETRY_ID.
[[nodiscard]] Hit hit_of(unsigned geometry, unsigned primitive, float t, float u, float v);

/// Traces rays one a call.
void intersect_one_by_one(RTCScene scene, std::span<const Ray> rays, std::span<Hit> hits);
void occluded_one_by_one(RTCScene scene, std::span<const Ray> rays, std::span<std::uint8_t> results);

}  // namespace grove::bench
