#include "grove/base/timer.h"
#include "grove/build/cost_model.h"
#include "grove/build/top_down.h"
#include "grove/registry/families.h"
#include "grove/registry/structure_accelerator.h"
#include "grove/traverse/bvh2_traversal.h"

namespace grove {
namespace {

constexpr std::size_t kHistogramSize = 33;

StructureStatistics measure(const Bvh2& bvh, const CostModel& cost) {
  StructureStatistics statistics;
  statistics.references = bvh.references.size();
  statistics.depth = bvh.depth;
  statistics.expected_cost = expected_cost(bvh, cost);
  statistics.leaf_sizes.resize(kHistogramSize);
  statistics.depths.resize(bvh.depth + 1);
  bvh.visit([&](const Box& /*box*/, std::uint32_t depth, std::uint32_t /*first*/, std::uint32_t count) {
    ++statistics.nodes;
    if (count == 0) return;
    ++statistics.leaves;
    ++statistics.leaf_sizes[std::min<std::size_t>(count, kHistogramSize - 1)];
    ++statistics.depths[depth];
  });
  return statistics;
}

template <Geometry G>
void visit_bvh(const TraceableBvh2<G>& structure, const std::function<void(const NodeView&)>& visit) {
  structure.bvh.visit([&](const Box& box, std::uint32_t depth, std::uint32_t /*first*/, std::uint32_t count) {
    visit({box, depth, count > 0, count});
  });
}

template <Geometry G>
std::unique_ptr<Accelerator> build_over(const Spec& spec, std::shared_ptr<const G> geometry) {
  TopDownSettings settings;
  settings.leaf_size = static_cast<std::uint32_t>(spec.number("leaf-size"));
  const Timer timer;
  Bvh2 bvh = build_binned(list_references(*geometry), settings);
  GROVE_ASSERT(bvh.validate(geometry->size()).empty());
  TraceableBvh2<G> structure(std::move(bvh), *geometry);
  const double seconds = timer.seconds();
  StructureStatistics statistics = measure(structure.bvh, settings.cost);
  statistics.bytes = structure.memory();
  statistics.primitives = geometry->size();
  statistics.build_seconds = seconds;
  const Box bounds = structure.bvh.bounds;
  return std::make_unique<StructureAccelerator<TraceableBvh2<G>, G>>(std::move(structure), std::move(geometry), spec.canonical(), bounds,
                                                                     std::move(statistics), visit_bvh<G>);
}

}  // namespace

StructureFamily describe_bvh() {
  return {"bvh",
          "bounding volume hierarchy over axis-aligned boxes, two children a node",
          {
              {"split", {"binned"}, 0, 0, 0, "how a set is parted: binned surface-area heuristic (Wald 2007)"},
              {"bounds", {"aabb"}, 0, 0, 0, "the bounding volume: axis-aligned boxes"},
              {"arity", {"2"}, 0, 0, 0, "children of an interior node"},
              {"leaf-size", {}, 1, 64, 8, "most primitives in a leaf; the cost model decides below it"},
          }};
}

std::unique_ptr<Accelerator> build_bvh(const Spec& spec, const GeometryPointer& geometry) {
  return std::visit([&](const auto& set) { return build_over(spec, set); }, geometry);
}

}  // namespace grove
