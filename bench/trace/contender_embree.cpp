#include <embree3/rtcore.h>

#include <utility>

#include "embree/embree_mesh.h"
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
    const RTCBuildQuality qualities[] = {RTC_BUILD_QUALITY_LOW, RTC_BUILD_QUALITY_MEDIUM, RTC_BUILD_QUALITY_HIGH};
    scene_ = new_mesh_scene(device_, *mesh_, qualities[static_cast<int>(settings_.quality)], settings_.robust);
    rtcCommitScene(scene_);
    return timer.seconds();
  }

  void release() final {
    if (scene_ != nullptr) rtcReleaseScene(scene_);
    if (device_ != nullptr) rtcReleaseDevice(device_);  // also lifts its limit on oneTBB's threads
    scene_ = nullptr;
    device_ = nullptr;
  }

  void intersect(std::span<const Ray> rays, std::span<Hit> hits) const override { intersect_one_by_one(scene_, rays, hits); }
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> results) const override { occluded_one_by_one(scene_, rays, results); }

 private:
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
