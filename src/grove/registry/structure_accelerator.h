#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "grove/base/check.h"
#include "grove/geometry/geometry_concept.h"
#include "grove/geometry/hit_filter.h"
#include "grove/registry/accelerator.h"

namespace grove {

/// A structure as it stands, and what building it told.
template <typename Structure>
struct StructureState {
  Structure structure;
  Box bounds;
  double build_seconds = 0.0;
  std::optional<double> expected_cost;  ///< where it is known without being counted
};

/// A structure whose rays are traced together: what a batch allows is used.
template <typename Structure, typename G>
concept TracesBatches = requires(const Structure& structure, const G& geometry, std::span<const Ray> rays, std::span<Hit> hits,
                                 std::span<std::uint8_t> results, std::span<TraversalCounts> counts) {
  trace_closest(structure, geometry, rays, hits, counts);
  trace_any(structure, geometry, rays, results, counts);
};

/// And whose kernels ask a filter about their hits, with `primitive` as in Hit.
template <typename Structure, typename G>
concept TracesFilteredBatches = requires(const Structure& structure, const G& geometry, std::span<const Ray> rays, std::span<Hit> hits,
                                         std::span<std::uint8_t> results, const BatchHitFilter& filter) {
  trace_closest(structure, geometry, rays, hits, filter);
  trace_any(structure, geometry, rays, results, filter);
};

/// The bridge from a structure and a geometry, both known at compile time, to Accelerator. `Structure` is plain data for which the
/// functions trace_closest(structure, geometry, ray, hit, counter) and trace_any(…) exist (rooms accel and traverse); how it is counted, drawn,
/// judged and made to follow its geometry is passed in, since only the registry's row knows.
///
/// Statistics are counted when they are first asked for: counting nodes takes a tenth of the time of the fastest builds.
template <typename Structure, Geometry G>
class StructureAccelerator final : public Accelerator {
 public:
  using State = StructureState<Structure>;
  using StatisticsCounter = StructureStatistics (*)(const State&, const G&);
  using NodeVisitor = void (*)(const Structure&, const std::function<void(const NodeView&)>&);
  using QualityMeasure = StructureQuality (*)(const Structure&, const G&);
  using Updater = std::function<UpdateReport(State&, const G&, const UpdateSettings&)>;

  StructureAccelerator(State state, std::shared_ptr<const G> geometry, std::string spec, StatisticsCounter statistics_counter,
                       NodeVisitor node_visitor, QualityMeasure quality_measure, Updater updater)
      : state_(std::move(state)),
        geometry_(std::move(geometry)),
        size_(geometry_->size()),
        spec_(std::move(spec)),
        statistics_counter_(statistics_counter),
        node_visitor_(node_visitor),
        quality_measure_(quality_measure),
        updater_(std::move(updater)) {}

  [[nodiscard]] const std::string& spec() const override { return spec_; }
  [[nodiscard]] const StructureStatistics& statistics() const override {
    const std::lock_guard lock(counting_);
    if (!statistics_) {
      statistics_ = statistics_counter_(state_, *geometry_);
      statistics_->primitives = geometry_->size();
      statistics_->build_seconds = state_.build_seconds;
    }
    return *statistics_;
  }
  [[nodiscard]] Box bounds() const override { return state_.bounds; }

  [[nodiscard]] StructureQuality measure_quality() const override { return quality_measure_(state_.structure, *geometry_); }
  void visit_nodes(const std::function<void(const NodeView&)>& visit) const override { node_visitor_(state_.structure, visit); }

  UpdateReport update(const UpdateSettings& settings) override {
    check_update(size_, geometry_->size(), settings);
    UpdateReport report = updater_(state_, *geometry_, settings);
    size_ = geometry_->size();
    statistics_.reset();
    return report;
  }

  [[nodiscard]] Hit closest_hit(const Ray& ray, TraversalCounts* counts) const override {
    return counts == nullptr ? closest(ray) : closest(ray, *counts);
  }

  [[nodiscard]] bool any_hit(const Ray& ray, TraversalCounts* counts) const override {
    if (counts == nullptr) return any(ray, NoCounter{});
    return any(ray, Counter(*counts));
  }

  [[nodiscard]] Hit closest_hit(const Ray& ray, const HitFilter& filter) const override {
    return closest(ray, [&](const Hit& /*hit*/) { return FilteringCounter<G>(filter, *geometry_); });
  }

  [[nodiscard]] bool any_hit(const Ray& ray, const HitFilter& filter) const override {
    return any(ray, FilteringCounter<G>(filter, *geometry_));
  }

  using Accelerator::any_hits;
  using Accelerator::closest_hits;
  void closest_hits(std::span<const Ray> rays, std::span<Hit> hits, const BatchHitFilter& filter) const override {
    GROVE_CHECK(rays.size() == hits.size());
    if constexpr (TracesFilteredBatches<Structure, G>) {
      trace_closest(state_.structure, *geometry_, rays, hits, filter);
      for (Hit& hit : hits)
        if (hit) geometry_->locate(hit);
    } else {
      Traceable::closest_hits(rays, hits, filter);
    }
  }

  void any_hits(std::span<const Ray> rays, std::span<std::uint8_t> results, const BatchHitFilter& filter) const override {
    GROVE_CHECK(rays.size() == results.size());
    if constexpr (TracesFilteredBatches<Structure, G>) {
      trace_any(state_.structure, *geometry_, rays, results, filter);
    } else {
      Traceable::any_hits(rays, results, filter);
    }
  }

  [[nodiscard]] Hit record_steps(const Ray& ray, TraversalRecord& record) const override {
    record.steps.clear();
    record.nested = {};
    return closest(ray, [&](const Hit& hit) { return Recorder(record, hit); });
  }

  void intersect(std::span<const Ray> rays, std::span<Hit> hits, std::span<TraversalCounts> counts) const override {
    GROVE_CHECK(rays.size() == hits.size() && (counts.empty() || counts.size() == rays.size()));
    if constexpr (TracesBatches<Structure, G>) {
      trace_closest(state_.structure, *geometry_, rays, hits, counts);
      for (Hit& hit : hits)
        if (hit) geometry_->locate(hit);
      return;
    }
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (counts.empty()) {
        hits[i] = closest(rays[i]);
      } else {
        counts[i] = {};
        hits[i] = closest(rays[i], counts[i]);
      }
    }
  }

  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> results, std::span<TraversalCounts> counts) const override {
    GROVE_CHECK(rays.size() == results.size() && (counts.empty() || counts.size() == rays.size()));
    if constexpr (TracesBatches<Structure, G>) {
      trace_any(state_.structure, *geometry_, rays, results, counts);
      return;
    }
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
  [[nodiscard]] Hit closest(const Ray& ray) const {
    return closest(ray, [](const Hit& /*hit*/) { return NoCounter(); });
  }
  [[nodiscard]] Hit closest(const Ray& ray, TraversalCounts& counts) const {
    return closest(ray, [&](const Hit& /*hit*/) { return Counter(counts); });
  }

  // `make_counter` is given the hit that the walk lowers.
  template <typename MakeCounter>
  Hit closest(const Ray& ray, const MakeCounter& make_counter) const {
    Hit hit;
    if (!ray.is_traceable()) return hit;
    hit.t = ray.t_max;
    auto counter = make_counter(hit);
    trace_closest(state_.structure, *geometry_, ray, hit, counter);
    if (hit) {
      geometry_->locate(hit);
    } else {
      hit.t = std::numeric_limits<float>::infinity();
    }
    return hit;
  }

  template <typename C>
  bool any(const Ray& ray, C counter) const {
    return ray.is_traceable() && trace_any(state_.structure, *geometry_, ray, counter);
  }

  State state_;
  std::shared_ptr<const G> geometry_;
  std::size_t size_;  // primitives that the structure knows
  std::string spec_;
  StatisticsCounter statistics_counter_;
  NodeVisitor node_visitor_;
  QualityMeasure quality_measure_;
  Updater updater_;
  mutable std::mutex counting_;
  mutable std::optional<StructureStatistics> statistics_;
};

}  // namespace grove
