#include <oneapi/tbb/task_arena.h>

#include <utility>

#include "grove/base/timer.h"
#include "grove/registry/registry.h"
#include "trace/contender.h"

namespace grove::bench {
namespace {

class Grove final : public Contender {
 public:
  Grove(std::shared_ptr<const TriangleMesh> mesh, std::string spec, Calls calls)
      : mesh_(std::move(mesh)), spec_(std::move(spec)), calls_(calls) {}

  [[nodiscard]] std::string name() const override { return spec_; }

  double build(int threads) override {
    structure_.reset();
    oneapi::tbb::task_arena arena(threads);
    const Timer timer;
    arena.execute([&] { structure_ = grove::build(GeometryPointer(mesh_), spec_); });
    return timer.seconds();
  }

  void release() override { structure_.reset(); }

  // With one ray a call there is one virtual call a ray, as the rival has one call a ray.
  void intersect(std::span<const Ray> rays, std::span<Hit> hits) const override {
    if (calls_ == Calls::all_rays) return structure_->intersect(rays, hits, {});
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = structure_->intersect(rays[i]);
  }
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> results) const override {
    if (calls_ == Calls::all_rays) return structure_->occluded(rays, results, {});
    for (std::size_t i = 0; i < rays.size(); ++i) results[i] = structure_->occluded(rays[i]) ? 1 : 0;
  }

 private:
  std::shared_ptr<const TriangleMesh> mesh_;
  std::string spec_;
  Calls calls_;
  std::unique_ptr<Accelerator> structure_;
};

}  // namespace

std::unique_ptr<Contender> make_grove(std::shared_ptr<const TriangleMesh> mesh, std::string spec, Calls calls) {
  return std::make_unique<Grove>(std::move(mesh), std::move(spec), calls);
}

}  // namespace grove::bench
