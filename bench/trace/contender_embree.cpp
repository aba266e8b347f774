#include <embree3/rtcore.h>

#include <limits>
#include <utility>

#include "grove/base/error.h"
#include "grove/base/timer.h"
#include "trace/contender.h"

namespace grove::bench {
namespace {

class Embree final : public Contender {
 public:
  Embree(std::shared_ptr<const TriangleMesh> mesh, EmbreeSettings settings) : mesh_(std::move(mesh)), settings_(std::move(settings)) {}
  ~Embree() override { release(); }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  [[nodiscard]] std::string name() const override {
    constexpr const char* kNames[] = {"embree low", "embree medium", "embree high"};
    std::string name = kNames[static_cast<int>(settings_.quality)];
    if (settings_.robust) name += " robust";
    return settings_.isa.empty() ? name : name + " " + settings_.isa;
  }

  double build(int threads) override {
    release();
    std::string configuration = "threads=" + std::to_string(threads);
    if (!settings_.isa.empty()) configuration += ",isa=" + settings_.isa;
    device_ = rtcNewDevice(configuration.c_str());
    if (device_ == nullptr) throw Error("Embree gave no device");
    const Timer timer;
    scene_ = rtcNewScene(device_);
    const RTCBuildQuality qualities[] = {RTC_BUILD_QUALITY_LOW, RTC_BUILD_QUALITY_MEDIUM, RTC_BUILD_QUALITY_HIGH};
    const RTCBuildQuality quality = qualities[static_cast<int>(settings_.quality)];
    rtcSetSceneFlags(scene_, settings_.robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    rtcSetSceneBuildQuality(scene_, quality);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    const auto vertices = mesh_->vertices();
    const auto triangles = mesh_->triangles();
    // Embree reads 16 bytes for the last vertex, so it gets a buffer of its own.
    auto* buffer =
        static_cast<Vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3), vertices.size()));
    std::copy(vertices.begin(), vertices.end(), buffer);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles.data(), 0, sizeof(Triangle),
                               triangles.size());
    rtcSetGeometryBuildQuality(geometry, quality);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
    return timer.seconds();
  }

  void release() final {
    if (scene_ != nullptr) rtcReleaseScene(scene_);
    if (device_ != nullptr) rtcReleaseDevice(device_);  // also lifts its limit on oneTBB's threads
    scene_ = nullptr;
    device_ = nullptr;
  }

  void intersect(std::span<const Ray> rays, std::span<Hit> hits) const override {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      RTCRayHit query;
      query.ray = to_embree(rays[i]);
      query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene_, &context, &query);
      Hit hit;
      if (query.hit.geomID != RTC_INVALID_GEOMETRY_ID) {
        hit.t = query.ray.tfar;
        hit.u = query.hit.u;
        hit.v = query.hit.v;
        hit.primitive = query.hit.primID;
        hit.geometry = 0;
      }
      hits[i] = hit;
    }
  }

  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> results) const override {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      RTCRay query = to_embree(rays[i]);
      rtcOccluded1(scene_, &context, &query);
      results[i] = query.tfar < 0.0F ? 1 : 0;
    }
  }

 private:
  static RTCRay to_embree(const Ray& ray) {
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

  std::shared_ptr<const TriangleMesh> mesh_;
  EmbreeSettings settings_;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

}  // namespace

std::unique_ptr<Contender> make_embree(std::shared_ptr<const TriangleMesh> mesh, EmbreeSettings settings) {
  return std::make_unique<Embree>(std::move(mesh), std::move(settings));
}

}  // namespace grove::bench
