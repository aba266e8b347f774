#pragma once

#include <memory>
#include <string>
#include <utility>

#include "grove/base/check.h"
#include "grove/geometry/geometry_concept.h"
#include "grove/registry/accelerator.h"

namespace grove {

/// The bridge from a structure and a geometry, both known at compile time, to Accelerator. `Structure` is plain data for which the
/// functions trace_closest(structure, geometry, ray, hit, counter) and trace_any(…) exist (rooms accel and traverse); `visit_nodes` is
/// passed in since only the registry's row knows how the structure is drawn.
template <typename Structure, Geometry G>
class StructureAccelerator final : public Accelerator {
 public:
  using NodeVisitor = void (*)(const Structure&, const std::function<void(const NodeView&)>&);

  StructureAccelerator(Structure structure, std::shared_ptr<const G> geometry, std::string spec, const Box& bounds,
                       StructureStatistics statistics, NodeVisitor node_visitor)
      : structure_(std::move(structure)),
        geometry_(std::move(geometry)),
        spec_(std::move(spec)),
        bounds_(bounds),
        statistics_(std::move(statistics)),
        node_visitor_(node_visitor) {}

  [[nodiscard]] const std::string& spec() const override { return spec_; }
  [[nodiscard]] const StructureStatistics& statistics() const override { return statistics_; }
  [[nodiscard]] Box bounds() const override { return bounds_; }

  void visit_nodes(const std::function<void(const NodeView&)>& visit) const override { node_visitor_(structure_, visit); }

  [[nodiscard]] Hit closest_hit(const Ray& ray, TraversalCounts* counts) const override {
    if (counts == nullptr) return closest(ray, NoCounter{});
    return closest(ray, Counter(*counts));
  }

  [[nodiscard]] bool any_hit(const Ray& ray, TraversalCounts* counts) const override {
    if (counts == nullptr) return any(ray, NoCounter{});
    return any(ray, Counter(*counts));
  }

  void intersect(std::span<const Ray> rays, std::span<Hit> hits, std::span<TraversalCounts> counts) const override {
    GROVE_CHECK(rays.size() == hits.size() && (counts.empty() || counts.size() == rays.size()));
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (counts.empty()) {
        hits[i] = closest(rays[i], NoCounter{});
      } else {
        counts[i] = {};
        hits[i] = closest(rays[i], Counter(counts[i]));
      }
    }
  }

  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> results, std::span<TraversalCounts> counts) const override {
    GROVE_CHECK(rays.size() == results.size() && (counts.empty() || counts.size() == rays.size()));
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (counts.empty()) {
        results[i] = any(rays[i], NoCounter{}) ? 1 : 0;
      } else {
        counts[i] = {};
        results[i] = any(rays[i], Counter(counts[i])) ? 1 : 0;
      }
    }
  }

 private:
  template <typename C>
  Hit closest(const Ray& ray, C counter) const {
    Hit hit;
    if (!ray.is_traceable()) return hit;
    hit.t = ray.t_max;
    trace_closest(structure_, *geometry_, ray, hit, counter);
    if (hit) {
      geometry_->locate(hit);
    } else {
      hit.t = std::numeric_limits<float>::infinity();
    }
    return hit;
  }

  template <typename C>
  bool any(const Ray& ray, C counter) const {
    return ray.is_traceable() && trace_any(structure_, *geometry_, ray, counter);
  }

  Structure structure_;
  std::shared_ptr<const G> geometry_;
  std::string spec_;
  Box bounds_;
  StructureStatistics statistics_;
  NodeVisitor node_visitor_;
};

}  // namespace grove
