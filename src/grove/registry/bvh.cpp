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
  statistics.bytes = bvh.memory();
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

void visit_bvh(const Bvh2& bvh, const std::function<void(const NodeView&)>& visit) {
  bvh.visit([&](const Box& box, std::uint32_t depth, std::uint32_t /*first*/, std::uint32_t count) {
    visit({box, depth, count > 0, count});
  });
}

template <Geometry G>
std::unique_ptr<Accelerator> build_over(const Spec& spec, std::shared_ptr<const G> geometry) {
  TopDownSettings settings;
  settings.leaf_size = static_cast<std::uint32_t>(spec.number("leaf-size"));
  const Timer timer;
  Bvh2 bvh = build_binned(list_references(*geometry), settings);
  const double seconds = timer.seconds();
  GROVE_ASSERT(bvh.validate(geometry->size()).empty());
  StructureStatistics statistics = measure(bvh, settings.cost);
  statistics.primitives = geometry->size();
  statistics.build_seconds = seconds;
  const Box bounds = bvh.bounds;
  return std::make_unique<StructureAccelerator<Bvh2, G>>(std::move(bvh), std::move(geometry), spec.canonical(), bounds,
                                                         std::move(statistics), visit_bvh);
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
