#include <cstdlib>
#include <utility>

#include "grove/base/check.h"
#include "grove/base/timer.h"
#include "grove/build/fast/pack_fast.h"
#include "grove/build/passes/collapse.h"
#include "grove/registry/bvh_binary.h"
#include "grove/registry/families.h"
#include "grove/registry/hierarchy_accelerator.h"
#include "grove/registry/update_by_rebuilding.h"
#include "grove/traverse/fast_traversal.h"
#include "grove/traverse/simd/fast_batch.h"
#include "grove/traverse/simd/fast_single.h"
#include "grove/traverse/wide_traversal.h"

namespace grove {
namespace {

// The binary hierarchies that the qualities start from, all with single references: leaves and widths are decided together afterwards.
BvhOptions options_for(const std::string& quality) {
  if (quality == "low") return BvhOptions(Spec::parse("bvh:split=lbvh,arity=8"));
  if (quality == "high") return BvhOptions(Spec::parse("bvh:split=spatial,optimize=reinsertion,arity=8"));
  return BvhOptions(Spec::parse("bvh:arity=8"));
}

template <Geometry G>
WideBvh<8> build_wide(const G& geometry, const std::string& quality) {
  CollapseSettings settings;
  settings.arity = 8;
  if constexpr (std::same_as<G, TriangleMesh>) {
    // A block is tested in about the time of a step through a node.
    settings.leaf_size = TriangleBlock::kWidth;
    settings.block_size = TriangleBlock::kWidth;
    settings.cost.intersection = settings.cost.traversal / TriangleBlock::kWidth;
  }
  return widen<8>(build_binary_hierarchy(geometry, options_for(quality)), settings);
}

// The hierarchy over a mesh, with the mesh's triangles in it.
struct FastStructure {
  FastBvh bvh;
};

template <typename C>
void trace_closest(const FastStructure& structure, const TriangleMesh& /*mesh*/, const Ray& ray, Hit& hit, C& counter) {
  if constexpr (TellsApart<C> || FiltersHits<C>) {
    // Kernels only count; the plain walk can tell of its steps and be told which hits count, and finds the same.
    trace_closest(structure.bvh, ray, hit, counter);
  } else {
    trace_single_closest(structure.bvh, ray, hit, counter.nested());
  }
}
template <typename C>
bool trace_any(const FastStructure& structure, const TriangleMesh& /*mesh*/, const Ray& ray, C& counter) {
  if constexpr (FiltersHits<C>) {
    return trace_any(structure.bvh, ray, counter);
  } else {
    return trace_single_any(structure.bvh, ray, counter.nested());
  }
}
void trace_closest(const FastStructure& structure, const TriangleMesh& /*mesh*/, std::span<const Ray> rays, std::span<Hit> hits,
                   std::span<TraversalCounts> counts) {
  trace_closest(structure.bvh, rays, hits, counts);
}
void trace_any(const FastStructure& structure, const TriangleMesh& /*mesh*/, std::span<const Ray> rays, std::span<std::uint8_t> results,
               std::span<TraversalCounts> counts) {
  trace_any(structure.bvh, rays, results, counts);
}

using FastState = StructureState<FastStructure>;

FastState build_over(const TriangleMesh& mesh, const std::string& quality) {
  const Timer timer;
  const WideBvh<8> wide = build_wide(mesh, quality);
  GROVE_ASSERT(wide.validate(mesh.size()).empty());
  FastStructure structure{pack_fast(wide, mesh)};
  const double seconds = timer.seconds();
  GROVE_ASSERT(structure.bvh.validate(mesh.size()).empty());
  const Box bounds = structure.bvh.bounds;
  return {std::move(structure), bounds, seconds, {}};
}

StructureStatistics count(const FastState& state, const TriangleMesh& /*mesh*/) {
  const FastBvh& bvh = state.structure.bvh;
  StructureStatistics statistics = count_nodes(bvh);
  statistics.expected_cost = expected_cost(bvh, CostModel{});
  statistics.bytes = bvh.memory();
  return statistics;
}

std::unique_ptr<Accelerator> build_over_mesh(const Spec& spec, std::shared_ptr<const TriangleMesh> mesh) {
  const std::string& quality = spec.value("quality");
  FastState state = build_over(*mesh, quality);
  const auto view = [](const FastStructure& s, const std::function<void(const NodeView&)>& visit) { view_nodes(s.bvh, visit); };
  const auto measure = [](const FastStructure& /*s*/, const TriangleMesh& /*m*/) { return StructureQuality{}; };
  const auto update = [quality](FastState& s, const TriangleMesh& m, const UpdateSettings& /*settings*/) {
    const auto size = [](const FastState& now) {
      return StructureMeasure{expected_cost(now.structure.bvh, CostModel{}), now.structure.bvh.references};
    };
    return update_by_rebuilding(
        s, m, [&](const TriangleMesh& changed) { return build_over(changed, quality); }, size);
  };
  return std::make_unique<StructureAccelerator<FastStructure, TriangleMesh>>(std::move(state), std::move(mesh), spec.canonical(), count,
                                                                             view, measure, update);
}

// Other primitives are tested one at a time, by the walk that all wide hierarchies share.
template <Geometry G>
std::unique_ptr<Accelerator> build_over_others(const Spec& spec, std::shared_ptr<const G> geometry) {
  return make_hierarchy_accelerator<WideBvh<8>>(spec, std::move(geometry),
                                                [quality = spec.value("quality")](const G& set) { return build_wide(set, quality); });
}

}  // namespace

StructureFamily describe_fast() {
  return {"fast",
          "the fast path: a wide hierarchy over blocks of triangles, traced many rays at a time",
          {{"quality",
            {"medium", "low", "high"},
            0,
            0,
            0,
            "how the hierarchy is built: by bins; along the Morton curve; or with spatial splits and reinsertion"}}};
}

std::unique_ptr<Accelerator> build_fast(const Spec& spec, const GeometryPointer& geometry) {
  // Once, before the first batch.
  static const bool is_target_chosen = [] {
    if (const char* const name = std::getenv("GROVE_FORCE_TARGET")) force_batch_target(name);  // NOLINT(concurrency-mt-unsafe)
    return true;
  }();
  static_cast<void>(is_target_chosen);
  return std::visit(
      [&]<typename G>(const std::shared_ptr<const G>& set) -> std::unique_ptr<Accelerator> {
        if constexpr (std::same_as<G, TriangleMesh>) {
          return build_over_mesh(spec, set);
        } else {
          return build_over_others(spec, set);
        }
      },
      geometry);
}

}  // namespace grove
