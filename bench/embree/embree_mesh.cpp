#include "embree/embree_mesh.h"

#include <algorithm>

namespace grove::bench {

RTCScene new_mesh_scene(RTCDevice device, const TriangleMesh& mesh, RTCBuildQuality quality, bool is_robust) {
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, is_robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  rtcSetSceneBuildQuality(scene, quality);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  const auto vertices = mesh.vertices();
  const auto triangles = mesh.triangles();
  // Embree reads 16 bytes for the last vertex, so it gets a buffer of its own.
  auto* buffer =
      static_cast<Vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3), vertices.size()));
  std::copy(vertices.begin(), vertices.end(), buffer);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles.data(), 0, sizeof(Triangle), triangles.size());
  rtcSetGeometryBuildQuality(geometry, quality);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  return scene;
}

RTCRay to_embree(const Ray& ray) {
  RTCRay query{};
  query.org_x = ray.origin.x;
  query.org_y = ray.origin.y;
  query.org_z = ray.origin.z;
  query.tnear = ray.t_min;
  query.dir_x = ray.direction.x;
  query.dir_y = ray.direction.y;
  query.dir_z = ray.direction.z;
  query.tfar = ray.t_max;
  query.mask = 0xffffffffU;
  return query;
}

Hit hit_of(unsigned geometry, unsigned primitive, float t, float u, float v) {
  Hit hit;
  if (geometry == RTC_INVALID_GEOMETRY_ID) return hit;
  hit.t = t;
  hit.u = u;
  hit.v = v;
  hit.primitive = primitive;
  hit.geometry = 0;
  return hit;
}

void intersect_one_by_one(RTCScene scene, std::span<const Ray> rays, std::span<Hit> hits) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    RTCRayHit query;
    query.ray = to_embree(rays[i]);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &query);
    hits[i] = hit_of(query.hit.geomID, query.hit.primID, query.ray.tfar, query.hit.u, query.hit.v);
  }
}

void occluded_one_by_one(RTCScene scene, std::span<const Ray> rays, std::span<std::uint8_t> results) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    RTCRay query = to_embree(rays[i]);
    rtcOccluded1(scene, &context, &query);
    results[i] = query.tfar < 0.0F ? 1 : 0;
  }
}

}  // namespace grove::bench
