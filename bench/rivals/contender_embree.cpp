#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <utility>

#include "embree/embree_mesh.h"
#include "grove/base/error.h"
#include "grove/base/timer.h"
#include "rivals/contender.h"

namespace grove::bench::rivals {
namespace {

constexpr std::array<std::size_t, 3> kCallSizes = {1, 8, 16};

std::string name_of(const EmbreeSettings& settings) {
  std::string name = settings.quality == EmbreeSettings::Quality::high ? "embree high" : "embree medium";
  if (settings.is_robust) name += " robust";
  if (!settings.isa.empty()) name += " " + settings.isa;
  return name;
}

// The packet types of Embree and the calls that take them.
struct Packet8 {
  static constexpr unsigned kWidth = 8;
  using Rays = RTCRay8;
  using RayHits = RTCRayHit8;
  static constexpr auto kIntersect = rtcIntersect8;
  static constexpr auto kOccluded = rtcOccluded8;
};
struct Packet16 {
  static constexpr unsigned kWidth = 16;
  using Rays = RTCRay16;
  using RayHits = RTCRayHit16;
  static constexpr auto kIntersect = rtcIntersect16;
  static constexpr auto kOccluded = rtcOccluded16;
};

template <typename Rays>
void put(const Ray& ray, Rays& packet, unsigned lane) {
  packet.org_x[lane] = ray.origin.x;
  packet.org_y[lane] = ray.origin.y;
  packet.org_z[lane] = ray.origin.z;
  packet.tnear[lane] = ray.t_min;
  packet.dir_x[lane] = ray.direction.x;
  packet.dir_y[lane] = ray.direction.y;
  packet.dir_z[lane] = ray.direction.z;
  packet.time[lane] = 0.0F;
  packet.tfar[lane] = ray.t_max;
  packet.mask[lane] = 0xffffffffU;
  packet.id[lane] = lane;
  packet.flags[lane] = 0;
}

class Embree final : public Entrant {
 public:
  Embree(std::shared_ptr<const TriangleMesh> mesh, const EmbreeSettings& settings)
      : mesh_(std::move(mesh)), settings_(settings), traits_{name_of(settings), true, settings.is_robust, false} {
    // Builds run in the caller's arena; a number of threads here would hold for the whole process.
    const std::string configuration = settings_.isa.empty() ? std::string() : "isa=" + settings_.isa;
    device_ = rtcNewDevice(configuration.c_str());
    if (device_ == nullptr) throw Error("Embree gave no device for " + traits_.name);
    rtcSetDeviceMemoryMonitorFunction(device_, count_memory, &memory_);
  }
  ~Embree() override {
    if (scene_ != nullptr) rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  [[nodiscard]] const Traits& traits() const override { return traits_; }
  [[nodiscard]] std::span<const std::size_t> call_sizes() const override { return kCallSizes; }
  [[nodiscard]] std::uint64_t bytes() const override { return bytes_; }

  double build() override {
    if (scene_ != nullptr) rtcReleaseScene(scene_);
    const Timer timer;
    const bool is_high = settings_.quality == EmbreeSettings::Quality::high;
    scene_ = new_mesh_scene(device_, *mesh_, is_high ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM, settings_.is_robust);
    const std::int64_t before = memory_;
    rtcCommitScene(scene_);
    bytes_ = static_cast<std::uint64_t>(std::max<std::int64_t>(0, memory_ - before));
    return timer.seconds();
  }

  void intersect(std::size_t call_size, bool is_coherent, std::span<const Ray> rays, std::span<Hit> hits) const override {
    if (call_size == Packet8::kWidth) return intersect_packets<Packet8>(is_coherent, rays, hits);
    if (call_size == Packet16::kWidth) return intersect_packets<Packet16>(is_coherent, rays, hits);
    intersect_one_by_one(scene_, rays, hits);
  }

  void occluded(std::size_t call_size, std::span<const Ray> rays, std::span<std::uint8_t> results) const override {
    if (call_size == Packet8::kWidth) return occluded_packets<Packet8>(rays, results);
    if (call_size == Packet16::kWidth) return occluded_packets<Packet16>(rays, results);
    occluded_one_by_one(scene_, rays, results);
  }

 private:
  static bool count_memory(void* total, ssize_t change, bool /*is_done*/) {
    *static_cast<std::atomic<std::int64_t>*>(total) += change;
    return true;
  }

  template <typename Packet>
  void intersect_packets(bool is_coherent, std::span<const Ray> rays, std::span<Hit> hits) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = is_coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    alignas(64) typename Packet::RayHits packet{};
    alignas(64) std::array<int, Packet::kWidth> valid;
    valid.fill(-1);
    for (std::size_t first = 0; first < rays.size(); first += Packet::kWidth) {
      const auto count = static_cast<unsigned>(std::min<std::size_t>(Packet::kWidth, rays.size() - first));
      for (unsigned lane = count; lane < Packet::kWidth; ++lane) valid[lane] = 0;
      for (unsigned lane = 0; lane < count; ++lane) {
        put(rays[first + lane], packet.ray, lane);
        packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
        packet.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
      }
      Packet::kIntersect(valid.data(), scene_, &context, &packet);
      for (unsigned lane = 0; lane < count; ++lane)
        hits[first + lane] =
            hit_of(packet.hit.geomID[lane], packet.hit.primID[lane], packet.ray.tfar[lane], packet.hit.u[lane], packet.hit.v[lane]);
    }
  }

  template <typename Packet>
  void occluded_packets(std::span<const Ray> rays, std::span<std::uint8_t> results) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    alignas(64) typename Packet::Rays packet{};
    alignas(64) std::array<int, Packet::kWidth> valid;
    valid.fill(-1);
    for (std::size_t first = 0; first < rays.size(); first += Packet::kWidth) {
      const auto count = static_cast<unsigned>(std::min<std::size_t>(Packet::kWidth, rays.size() - first));
      for (unsigned lane = count; lane < Packet::kWidth; ++lane) valid[lane] = 0;
      for (unsigned lane = 0; lane < count; ++lane) put(rays[first + lane], packet, lane);
      Packet::kOccluded(valid.data(), scene_, &context, &packet);
      for (unsigned lane = 0; lane < count; ++lane) results[first + lane] = packet.tfar[lane] < 0.0F ? 1 : 0;
    }
  }

  std::shared_ptr<const TriangleMesh> mesh_;
  EmbreeSettings settings_;
  Traits traits_;
  std::atomic<std::int64_t> memory_{0};
  std::uint64_t bytes_ = 0;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

}  // namespace

std::unique_ptr<Entrant> make_embree(std::shared_ptr<const TriangleMesh> mesh, const EmbreeSettings& settings) {
  return std::make_unique<Embree>(std::move(mesh), settings);
}

}  // namespace grove::bench::rivals
