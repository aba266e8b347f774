#include "grove/base/check.h"
#include "grove/base/timer.h"
#include "grove/build/kd_tree/add_ropes.h"
#include "grove/build/kd_tree/build_kd_tree.h"
#include "grove/build/kd_tree/update_kd_tree.h"
#include "grove/registry/cell_tree_accelerator.h"
#include "grove/registry/families.h"
#include "grove/registry/kd_tree_statistics.h"
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
using KdTreeState = StructureState<TraceableKdTree<G>>;

template <Geometry G>
KdTreeState<G> build_state(const G& geometry, const KdTreeOptions& options) {
  const Timer timer;
  KdTree tree = build_kd_tree(geometry, options.settings);
  GROVE_ASSERT(tree.validate(geometry.size()).empty());
  KdRopes ropes = options.has_ropes ? add_ropes(tree) : KdRopes();
  TraceableKdTree<G> structure(std::move(tree), std::move(ropes), geometry, options.mailbox);
  const double seconds = timer.seconds();
  const Box bounds = structure.tree.bounds;
  return {std::move(structure), bounds, seconds, {}};
}

/// Updates one tree: locally where it is told what changed and that is not most of it, else by building anew.
template <Geometry G>
class KdTreeFollower {
 public:
  explicit KdTreeFollower(const KdTreeOptions& options) : options_(options), updater_(options.settings) {}

  UpdateReport operator()(KdTreeState<G>& state, const G& geometry, const UpdateSettings& settings) {
    const Timer timer;
    UpdateReport report;
    if (is_worth_local(settings, geometry.size(), kLargestShare) && follow(state, geometry, settings, report)) {
      report.seconds = timer.seconds();
      return report;
    }
    const double built_cost = updater_.built_cost();
    updater_.forget();
    const auto measure = [](const KdTreeState<G>& now) { return StructureMeasure{cost_of(now), now.structure.tree.references.size()}; };
    report = update_by_rebuilding(
        state, geometry, [&](const G& changed) { return build_state(changed, options_); }, measure);
    if (built_cost > 0.0) report.built_cost = built_cost;
    return report;
  }

 private:
  // Local updates of more take longer than building (docs/kdtree.md).
  static constexpr std::size_t kLargestShare = 6;

  // Returns false where the tree is to be built anew.
  bool follow(KdTreeState<G>& state, const G& geometry, const UpdateSettings& settings, UpdateReport& report) {
    TraceableKdTree<G>& structure = state.structure;
    if (options_.has_ropes) remove_ropes(structure.tree, structure.ropes);
    KdRebuildRule rule;
    rule.rays = settings.policy == UpdatePolicy::automatic ? settings.rays : 0.0;
    const KdTreeUpdate update = updater_.update(structure.tree, geometry, settings.changed, rule);
    if (update.must_rebuild) return false;
    GROVE_ASSERT(structure.tree.validate(geometry.size()).empty());
    if (options_.has_ropes) structure.ropes = add_ropes(structure.tree);
    const KdSlots all{0, static_cast<std::uint32_t>(structure.tree.references.size())};
    structure.refresh(geometry, update.is_compacted ? std::span(&all, 1) : update.slots);
    report.method = UpdateMethod::local;
    report.built_cost = updater_.built_cost();
    report.cost = update.cost;
    report.rebuilt_references = update.rebuilt_references;
    state.expected_cost = update.cost;
    state.bounds = structure.tree.bounds;
    return true;
  }

  KdTreeOptions options_;
  KdTreeUpdater updater_;
};

template <Geometry G>
std::unique_ptr<Accelerator> build_over(const Spec& spec, std::shared_ptr<const G> geometry) {
  const KdTreeOptions options(spec);
  KdTreeState<G> state = build_state(*geometry, options);
  return make_cell_tree_accelerator(spec.canonical(), std::move(state), std::move(geometry), KdTreeFollower<G>(options));
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
