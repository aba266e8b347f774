#include <algorithm>
#include <utility>

#include "grove/base/timer.h"
#include "grove/registry/registry.h"
#include "rivals/contender.h"

namespace grove::bench::rivals {
namespace {

class Grove final : public Entrant {
 public:
  Grove(std::shared_ptr<const TriangleMesh> mesh, std::string spec, std::vector<std::size_t> call_sizes)
      : mesh_(std::move(mesh)), traits_{std::move(spec), false, true, true}, call_sizes_(std::move(call_sizes)) {
    // The one choice among Grove's that gives up both.
    const bool rounds = traits_.name.find("triangles=fast") != std::string::npos;
    traits_.is_robust = traits_.is_exact = !rounds;
  }

  [[nodiscard]] const Traits& traits() const override { return traits_; }
  [[nodiscard]] std::span<const std::size_t> call_sizes() const override { return call_sizes_; }

  double build() override {
    structure_.reset();
    const Timer timer;
    structure_ = grove::build(GeometryPointer(mesh_), traits_.name);
    return timer.seconds();
  }
  [[nodiscard]] std::uint64_t bytes() const override { return structure_->statistics().bytes; }

  void intersect(std::size_t call_size, bool /*is_coherent*/, std::span<const Ray> rays, std::span<Hit> hits) const override {
    if (call_size == 1) {
      for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = structure_->intersect(rays[i]);
      return;
    }
    for (std::size_t first = 0; first < rays.size(); first += call_size) {
      const std::size_t count = std::min(call_size, rays.size() - first);
      structure_->intersect(rays.subspan(first, count), hits.subspan(first, count));
    }
  }

  void occluded(std::size_t call_size, std::span<const Ray> rays, std::span<std::uint8_t> results) const override {
    if (call_size == 1) {
      for (std::size_t i = 0; i < rays.size(); ++i) results[i] = structure_->occluded(rays[i]) ? 1 : 0;
      return;
    }
    for (std::size_t first = 0; first < rays.size(); first += call_size) {
      const std::size_t count = std::min(call_size, rays.size() - first);
      structure_->occluded(rays.subspan(first, count), results.subspan(first, count));
    }
  }

 private:
  std::shared_ptr<const TriangleMesh> mesh_;
  Traits traits_;
  std::vector<std::size_t> call_sizes_;
  std::unique_ptr<Accelerator> structure_;
};

}  // namespace

std::unique_ptr<Entrant> make_grove(std::shared_ptr<const TriangleMesh> mesh, std::string spec, std::vector<std::size_t> call_sizes) {
  return std::make_unique<Grove>(std::move(mesh), std::move(spec), std::move(call_sizes));
}

}  // namespace grove::bench::rivals
