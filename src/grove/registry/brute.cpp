#include "grove/base/timer.h"
#include "grove/registry/families.h"
#include "grove/registry/structure_accelerator.h"
#include "grove/traverse/brute_traversal.h"

namespace grove {
namespace {

template <Geometry G>
StructureState<Brute> look_at(const G& geometry) {
  const Timer timer;
  StructureState<Brute> state;
  StructureStatistics& statistics = state.statistics;
  for (std::size_t i = 0; i < geometry.size(); ++i) {
    const Box box = geometry.bounds(i);
    if (box.is_empty()) continue;
    state.bounds.grow(box);
    ++statistics.references;
  }
  statistics.primitives = geometry.size();
  statistics.nodes = 1;
  statistics.leaves = 1;
  statistics.expected_cost = static_cast<double>(statistics.references);
  statistics.depths = {1};
  statistics.largest_leaf = static_cast<std::uint32_t>(statistics.references);
  statistics.build_seconds = timer.seconds();
  return state;
}

template <Geometry G>
UpdateReport update(StructureState<Brute>& state, const G& geometry, const UpdateSettings& /*settings*/) {
  UpdateReport report;
  report.built_cost = state.statistics.expected_cost;
  state = look_at(geometry);
  report.cost = state.statistics.expected_cost;
  report.rebuilt_references = state.statistics.references;
  report.seconds = state.statistics.build_seconds;
  return report;
}

template <Geometry G>
std::unique_ptr<Accelerator> build_over(std::string spec, std::shared_ptr<const G> geometry) {
  const auto visit = [](const Brute&, const std::function<void(const NodeView&)>&) {};
  const auto measure = [](const Brute&, const G&) { return StructureQuality{}; };
  StructureState<Brute> state = look_at(*geometry);
  return std::make_unique<StructureAccelerator<Brute, G>>(std::move(state), std::move(geometry), std::move(spec), visit, measure,
                                                          update<G>);
}

}  // namespace

StructureFamily describe_brute() {
  return {"brute", "tests every primitive; the reference for correctness", {}};
}

std::unique_ptr<Accelerator> build_brute(const Spec& spec, const GeometryPointer& geometry) {
  return std::visit([&](const auto& set) { return build_over(spec.canonical(), set); }, geometry);
}

}  // namespace grove
