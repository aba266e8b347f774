#include "grove/base/check.h"
#include "grove/base/timer.h"
#include "grove/build/kd_tree/add_ropes.h"
#include "grove/build/kd_tree/build_kd_tree.h"
#include "grove/registry/families.h"
#include "grove/registry/kd_tree_statistics.h"
#include "grove/registry/structure_accelerator.h"
#include "grove/registry/update_by_rebuilding.h"
#include "grove/traverse/traceable_kd_tree.h"

namespace grove {
namespace {

KdSplit parse_split(const std::string& name) {
  if (name == "binned") return KdSplit::binned;
  if (name == "object-median") return KdSplit::object_median;
  return name == "spatial-median" ? KdSplit::spatial_median : KdSplit::sah;
}

struct KdTreeOptions {
  explicit KdTreeOptions(const Spec& spec)
      : has_ropes(spec.value("walk") == "ropes"), mailbox(spec.value("mailbox") == "true" ? UseMailbox::yes : UseMailbox::no) {
    settings.split = parse_split(spec.value("split"));
    settings.clip = spec.value("clip") == "true";
    settings.empty_bonus = 0.01F * static_cast<float>(spec.number("empty-bonus"));
    settings.most_depth = static_cast<std::uint32_t>(spec.number("max-depth"));
    settings.leaf_size = static_cast<std::uint32_t>(spec.number("leaf-size"));
  }

  KdTreeSettings settings;
  bool has_ropes;
  UseMailbox mailbox;
};

template <Geometry G>
StructureState<TraceableKdTree<G>> build_state(const G& geometry, const KdTreeOptions& options) {
  const Timer timer;
  KdTree tree = build_kd_tree(geometry, options.settings);
  GROVE_ASSERT(tree.validate(geometry.size()).empty());
  KdRopes ropes = options.has_ropes ? add_ropes(tree) : KdRopes();
  TraceableKdTree<G> structure(std::move(tree), std::move(ropes), geometry, options.mailbox);
  const double seconds = timer.seconds();
  const Box bounds = structure.tree.bounds;
  return {std::move(structure), bounds, seconds, {}};
}

template <Geometry G>
std::unique_ptr<Accelerator> build_over(const Spec& spec, std::shared_ptr<const G> geometry) {
  using Structure = TraceableKdTree<G>;
  using State = StructureState<Structure>;
  const KdTreeOptions options(spec);
  const auto count = [](const State& state, const G& /*geometry*/) {
    StructureStatistics statistics = count_nodes(state.structure.tree);
    statistics.expected_cost = expected_cost(state.structure.tree, CostModel());
    statistics.bytes = state.structure.memory();
    return statistics;
  };
  const auto view = [](const Structure& structure, const std::function<void(const NodeView&)>& visit) {
    view_nodes(structure.tree, visit);
  };
  // Overlap is a measure of hierarchies: cells have none.
  const auto measure = [](const Structure&, const G&) { return StructureQuality{}; };
  // Planes do not follow what moves: the tree is built anew.
  const auto update = [options](State& state, const G& set, const UpdateSettings& /*settings*/) {
    const auto size = [](const State& now) {
      return StructureMeasure{expected_cost(now.structure.tree, CostModel()), now.structure.tree.references.size()};
    };
    return update_by_rebuilding(
        state, set, [&](const G& changed) { return build_state(changed, options); }, size);
  };
  State state = build_state(*geometry, options);
  return std::make_unique<StructureAccelerator<Structure, G>>(std::move(state), std::move(geometry), spec.canonical(), count, view, measure,
                                                              update);
}

}  // namespace

StructureFamily describe_kd_tree() {
  return {
      "kdtree",
      "kd-tree: planes across the axes, each primitive in every cell that it reaches into",
      {
          {"split",
           {"sah", "binned", "object-median", "spatial-median"},
           0,
           0,
           0,
           "where the plane is: at the least surface-area cost of all planes, or of a few between bins; with equal counts on both sides; "
           "or in the middle"},
          {"clip", {"true", "false"}, 0, 0, 0, "whether primitives are clipped to cells, or their boxes are"},
          {"walk",
           {"stack", "ropes"},
           0,
           0,
           0,
           "how a ray comes from leaf to leaf: by a stack of pending nodes, or by links between neighbours"},
          {"mailbox",
           {"true", "false"},
           0,
           0,
           0,
           "whether a ray remembers what it was tested against, so as not to test it in the next cell again"},
          {"empty-bonus", {}, 0, 90, 20, "by how many percent a plane is cheaper that cuts off empty space"},
          {"max-depth", {}, 0, 64, 0, "most planes above a leaf; 0 for 8 + 1.3 log2 of the number of primitives"},
          {"leaf-size", {}, 1, 64, 1, "sets of at most this many primitives are not parted; the cost decides above it"},
      }};
}

std::unique_ptr<Accelerator> build_kd_tree(const Spec& spec, const GeometryPointer& geometry) {
  return std::visit([&](const auto& set) { return build_over(spec, set); }, geometry);
}

}  // namespace grove
