#include "grove/base/timer.h"
#include "grove/registry/families.h"
#include "grove/registry/structure_accelerator.h"
#include "grove/registry/update_by_rebuilding.h"
#include "grove/traverse/brute_traversal.h"

namespace grove {
namespace {

template <Geometry G>
StructureState<Brute> look_at(const G& geometry) {
  const Timer timer;
  StructureState<Brute> state;
  std::uint64_t hittable = 0;
  for (std::size_t i = 0; i < geometry.size(); ++i) {
    const Box box = geometry.bounds(i);
    if (box.is_empty()) continue;
    state.bounds.grow(box);
    ++hittable;
  }
  // Every primitive is tested, whatever the ray meets.
  state.expected_cost = static_cast<double>(hittable);
  state.build_seconds = timer.seconds();
  return state;
}

template <Geometry G>
StructureStatistics count(const StructureState<Brute>& state, const G& /*geometry*/) {
  StructureStatistics statistics;
  statistics.references = static_cast<std::uint64_t>(*state.expected_cost);
  statistics.nodes = 1;
  statistics.leaves = 1;
  statistics.expected_cost = *state.expected_cost;
  statistics.depths = {1};
  statistics.largest_leaf = static_cast<std::uint32_t>(statistics.references);
  return statistics;
}

template <Geometry G>
UpdateReport update(StructureState<Brute>& state, const G& geometry, const UpdateSettings& /*settings*/) {
  const auto measure = [](const StructureState<Brute>& s) {
    return StructureMeasure{*s.expected_cost, static_cast<std::uint64_t>(*s.expected_cost)};
  };
  return update_by_rebuilding(state, geometry, look_at<G>, measure);
}

template <Geometry G>
std::unique_ptr<Accelerator> build_over(std::string spec, std::shared_ptr<const G> geometry) {
  const auto visit = [](const Brute&, const std::function<void(const NodeView&)>&) {};
  const auto measure = [](const Brute&, const G&) { return StructureQuality{}; };
  const StructureState<Brute> state = look_at(*geometry);
  return std::make_unique<StructureAccelerator<Brute, G>>(state, std::move(geometry), std::move(spec), count<G>, visit, measure, update<G>);
}

}  // namespace

StructureFamily describe_brute() {
  return {"brute", "tests every primitive; the reference for correctness", {}};
}

std::unique_ptr<Accelerator> build_brute(const Spec& spec, const GeometryPointer& geometry) {
  return std::visit([&](const auto& set) { return build_over(spec.canonical(), set); }, geometry);
}

}  // namespace grove
