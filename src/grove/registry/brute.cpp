#include "grove/base/timer.h"
#include "grove/registry/families.h"
#include "grove/registry/structure_accelerator.h"
#include "grove/traverse/brute_traversal.h"

namespace grove {
namespace {

template <Geometry G>
std::unique_ptr<Accelerator> build_over(std::string spec, std::shared_ptr<const G> geometry) {
  const Timer timer;
  Box bounds;
  std::uint64_t references = 0;
  for (std::size_t i = 0; i < geometry->size(); ++i) {
    const Box box = geometry->bounds(i);
    if (box.is_empty()) continue;
    bounds.grow(box);
    ++references;
  }
  StructureStatistics statistics;
  statistics.primitives = geometry->size();
  statistics.references = references;
  statistics.nodes = 1;
  statistics.leaves = 1;
  statistics.expected_cost = static_cast<double>(references);
  statistics.depths = {1};
  statistics.build_seconds = timer.seconds();
  const auto visit = [](const Brute&, const std::function<void(const NodeView&)>&) {};
  return std::make_unique<StructureAccelerator<Brute, G>>(Brute{}, std::move(geometry), std::move(spec), bounds, std::move(statistics),
                                                          visit);
}

}  // namespace

StructureFamily describe_brute() {
  return {"brute", "tests every primitive; the reference for correctness", {}};
}

std::unique_ptr<Accelerator> build_brute(const Spec& spec, const GeometryPointer& geometry) {
  return std::visit([&](const auto& set) { return build_over(spec.canonical(), set); }, geometry);
}

}  // namespace grove
