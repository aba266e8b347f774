#include <concepts>
#include <cstdlib>
#include <type_traits>
#include <utility>

#include "grove/base/check.h"
#include "grove/base/timer.h"
#include "grove/build/fast/fast_references.h"
#include "grove/build/fast/pack_fast.h"
#include "grove/build/passes/collapse.h"
#include "grove/registry/bvh_binary.h"
#include "grove/registry/families.h"
#include "grove/registry/fast_update.h"
#include "grove/registry/hierarchy_accelerator.h"
#include "grove/traverse/fast_traversal.h"
#include "grove/traverse/instance_batch.h"
#include "grove/traverse/simd/fast_batch.h"
#include "grove/traverse/simd/fast_single.h"
#include "grove/traverse/wide_traversal.h"

namespace grove {
namespace {

// The binary hierarchies that the qualities start from: leaves and widths are decided together afterwards.
BvhOptions options_for(const std::string& quality) {
  if (quality == "low") return BvhOptions(Spec::parse("bvh:split=lbvh,arity=8"));
  if (quality == "high") {
    BvhOptions options(Spec::parse("bvh:split=spatial,optimize=reinsertion,arity=8"));
    // A third of the time that trying everything takes, for the same steps and tests a ray (docs/fast.md).
    options.duplication_budget = 0.3;
    options.least_overlap_of_range = 0.2;
    options.reinsertion.rounds = 4;
    options.reinsertion.largest = 0.3;
    return options;
  }
  return BvhOptions(Spec::parse("bvh:arity=8"));
}

template <Geometry G>
WideBvh<8> build_wide(const G& geometry, const std::string& quality) {
  return widen<8>(build_binary_hierarchy(geometry, options_for(quality)), {});
}

template <typename Bvh>
Bvh build_blocks(const TriangleMesh& mesh, const std::string& quality) {
  BvhOptions options = options_for(quality);
  // So that sets are split where blocks come out full.
  options.block_size = TriangleBlock::kWidth;
  CollapseSettings settings;
  settings.leaf_size = TriangleBlock::kWidth;
  settings.cost.block_size = TriangleBlock::kWidth;
  // A block is tested in about the time of a step through a node.
  settings.cost.intersection = settings.cost.traversal / TriangleBlock::kWidth;
  return pack_fast<Bvh>(build_binary_hierarchy(mesh, options), mesh, settings);
}

// The hierarchy over a mesh, with the mesh's triangles or their numbers in it, and how they are tested.
template <typename Bvh>
struct FastStructure {
  Bvh bvh;
  TriangleTest test;

  [[nodiscard]] FastScene<Bvh> with(const TriangleMesh& mesh) const { return {bvh, mesh.vertices().data()}; }
};

// What a counter that filters has to say, for kernels.
template <FiltersHits C>
HitFilter filter_of(C& counter) {
  return {[](void* context, const Hit& hit) { return static_cast<const C*>(context)->accepts(hit); }, &counter};
}

template <typename Bvh, typename C>
void trace_closest(const FastStructure<Bvh>& structure, const TriangleMesh& mesh, const Ray& ray, Hit& hit, C& counter) {
  if constexpr (TellsApart<C>) {
    // Kernels only count; the plain walk can tell of its steps, and finds the same.
    trace_closest(structure.with(mesh), ray, hit, counter);
  } else if constexpr (FiltersHits<C>) {
    trace_filtered_closest(structure.with(mesh), structure.test, ray, hit, filter_of(counter));
  } else {
    trace_single_closest(structure.with(mesh), structure.test, ray, hit, counter.nested());
  }
}
template <typename Bvh, typename C>
bool trace_any(const FastStructure<Bvh>& structure, const TriangleMesh& mesh, const Ray& ray, C& counter) {
  if constexpr (FiltersHits<C>) {
    return trace_filtered_any(structure.with(mesh), structure.test, ray, filter_of(counter));
  } else {
    return trace_single_any(structure.with(mesh), structure.test, ray, counter.nested());
  }
}
template <typename Bvh>
void trace_closest(const FastStructure<Bvh>& structure, const TriangleMesh& mesh, std::span<const Ray> rays, std::span<Hit> hits,
                   std::span<TraversalCounts> counts) {
  trace_closest(structure.with(mesh), structure.test, rays, hits, counts);
}
template <typename Bvh>
void trace_any(const FastStructure<Bvh>& structure, const TriangleMesh& mesh, std::span<const Ray> rays, std::span<std::uint8_t> results,
               std::span<TraversalCounts> counts) {
  trace_any(structure.with(mesh), structure.test, rays, results, counts);
}
template <typename Bvh>
void trace_closest(const FastStructure<Bvh>& structure, const TriangleMesh& mesh, std::span<const Ray> rays, std::span<Hit> hits,
                   const BatchHitFilter& filter) {
  LocatingFilter<TriangleMesh> locating(filter, mesh);
  trace_closest(structure.with(mesh), structure.test, rays, hits, locating.filter());
}
template <typename Bvh>
void trace_any(const FastStructure<Bvh>& structure, const TriangleMesh& mesh, std::span<const Ray> rays, std::span<std::uint8_t> results,
               const BatchHitFilter& filter) {
  LocatingFilter<TriangleMesh> locating(filter, mesh);
  trace_any(structure.with(mesh), structure.test, rays, results, locating.filter());
}

template <typename Bvh>
using FastState = StructureState<FastStructure<Bvh>>;

template <typename Bvh>
FastState<Bvh> build_over(const TriangleMesh& mesh, const std::string& quality, TriangleTest test) {
  const Timer timer;
  FastStructure<Bvh> structure{build_blocks<Bvh>(mesh, quality), test};
  const double seconds = timer.seconds();
  GROVE_ASSERT(structure.bvh.validate(mesh.size(), mesh.vertices()).empty());
  const Box bounds = structure.bvh.bounds;
  return {std::move(structure), bounds, seconds, {}};
}

template <typename Bvh>
StructureStatistics count(const FastState<Bvh>& state, const TriangleMesh& /*mesh*/) {
  const Bvh& bvh = state.structure.bvh;
  StructureStatistics statistics = count_nodes(bvh);
  statistics.expected_cost = state.expected_cost ? *state.expected_cost : expected_cost(bvh, CostModel{});
  statistics.bytes = bvh.memory();
  return statistics;
}

template <typename Bvh>
std::unique_ptr<Accelerator> build_over_mesh(const Spec& spec, std::shared_ptr<const TriangleMesh> mesh) {
  const std::string& quality = spec.value("quality");
  const TriangleTest test = spec.value("triangles") == "fast" ? TriangleTest::fast : TriangleTest::watertight;
  FastState<Bvh> state = build_over<Bvh>(*mesh, quality, test);
  const auto view = [](const FastStructure<Bvh>& s, const std::function<void(const NodeView&)>& visit) { view_nodes(s.bvh, visit); };
  const auto measure = [](const FastStructure<Bvh>& s, const TriangleMesh& m) { return measure_quality(FastReferences<Bvh>(s.bvh), m); };
  const auto rebuild = [quality, test](const TriangleMesh& changed) { return build_over<Bvh>(changed, quality, test); };
  FastUpdater<FastState<Bvh>, decltype(rebuild)> update(rebuild);
  return std::make_unique<StructureAccelerator<FastStructure<Bvh>, TriangleMesh>>(std::move(state), std::move(mesh), spec.canonical(),
                                                                                  count<Bvh>, view, measure, std::move(update));
}

// Other primitives are tested one at a time, by the walk that all wide hierarchies share; but batches of rays at instances are handed down as batches.
struct FastTop : WideBvh<8> {};

using FastTopStructure = TraceableHierarchy<FastTop, InstanceSet>;

void trace_closest(const FastTopStructure& structure, const InstanceSet& instances, std::span<const Ray> rays, std::span<Hit> hits,
                   std::span<TraversalCounts> counts) {
  if (counts.empty()) return InstanceBatch(structure.bvh, instances).trace_closest(rays, hits);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    counts[i] = {};
    hits[i] = {};
    if (!rays[i].is_traceable()) continue;
    hits[i].t = rays[i].t_max;
    Counter counter(counts[i]);
    trace_closest(structure, instances, rays[i], hits[i], counter);
    if (!hits[i]) hits[i] = {};
  }
}
void trace_any(const FastTopStructure& structure, const InstanceSet& instances, std::span<const Ray> rays, std::span<std::uint8_t> results,
               std::span<TraversalCounts> counts) {
  if (counts.empty()) return InstanceBatch(structure.bvh, instances).trace_any(rays, results);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    counts[i] = {};
    Counter counter(counts[i]);
    results[i] = rays[i].is_traceable() && trace_any(structure, instances, rays[i], counter) ? 1 : 0;
  }
}

void trace_closest(const FastTopStructure& structure, const InstanceSet& instances, std::span<const Ray> rays, std::span<Hit> hits,
                   const BatchHitFilter& filter) {
  InstanceBatch(structure.bvh, instances, &filter).trace_closest(rays, hits);
}
void trace_any(const FastTopStructure& structure, const InstanceSet& instances, std::span<const Ray> rays, std::span<std::uint8_t> results,
               const BatchHitFilter& filter) {
  InstanceBatch(structure.bvh, instances, &filter).trace_any(rays, results);
}

template <Geometry G>
std::unique_ptr<Accelerator> build_over_others(const Spec& spec, std::shared_ptr<const G> geometry) {
  using Hierarchy = std::conditional_t<std::same_as<G, InstanceSet>, FastTop, WideBvh<8>>;
  return make_hierarchy_accelerator<Hierarchy>(
      spec, std::move(geometry), [quality = spec.value("quality")](const G& set) { return Hierarchy{build_wide(set, quality)}; });
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
            "how the hierarchy is built: by bins; along the Morton curve; or with spatial splits and reinsertion"},
           {"nodes",
            {"full", "compressed"},
            0,
            0,
            0,
            "planes and triangles as floats; or planes on a grid of each node's and corners by their numbers in the mesh, in less than "
            "half of the "
            "memory (meshes only)"},
           {"triangles",
            {"watertight", "fast"},
            0,
            0,
            0,
            "the test of all other structures; or one in floats alone, which may miss at edges (meshes only)"}}};
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
          return spec.value("nodes") == "compressed" ? build_over_mesh<CompressedFastBvh>(spec, set) : build_over_mesh<FastBvh>(spec, set);
        } else {
          return build_over_others(spec, set);
        }
      },
      geometry);
}

}  // namespace grove
