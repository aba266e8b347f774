#include "grove/registry/bvh_binary.h"

#include "grove/base/check.h"
#include "grove/base/timer.h"
#include "grove/build/cost_model.h"
#include "grove/registry/bvh_forms.h"
#include "grove/registry/hierarchy_statistics.h"
#include "grove/registry/structure_accelerator.h"
#include "grove/traverse/bvh2_traversal.h"

namespace grove {
namespace {

template <Geometry G>
std::unique_ptr<Accelerator> build_over(const Spec& spec, std::shared_ptr<const G> geometry) {
  const Timer timer;
  Bvh2 bvh = build_binary_hierarchy(*geometry, BvhOptions(spec));
  GROVE_ASSERT(bvh.validate(geometry->size()).empty());
  TraceableBvh2<G> structure(std::move(bvh), *geometry);
  const double seconds = timer.seconds();
  StructureStatistics statistics = count_nodes(structure.bvh);
  statistics.expected_cost = expected_cost(structure.bvh, CostModel{});
  statistics.bytes = structure.memory();
  statistics.primitives = geometry->size();
  statistics.build_seconds = seconds;
  const Box bounds = structure.bvh.bounds;
  const auto view = [](const TraceableBvh2<G>& s, const std::function<void(const NodeView&)>& visit) { view_nodes(s.bvh, visit); };
  return std::make_unique<StructureAccelerator<TraceableBvh2<G>, G>>(std::move(structure), std::move(geometry), spec.canonical(), bounds,
                                                                     std::move(statistics), view);
}

}  // namespace

std::unique_ptr<Accelerator> build_binary_bvh(const Spec& spec, const GeometryPointer& geometry) {
  return std::visit([&](const auto& set) { return build_over(spec, set); }, geometry);
}

}  // namespace grove
