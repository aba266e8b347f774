#include <optional>
#include <utility>

#include "grove/base/check.h"
#include "grove/base/error.h"
#include "grove/base/timer.h"
#include "grove/build/octree/build_octree.h"
#include "grove/build/octree/update_octree.h"
#include "grove/registry/cell_tree_accelerator.h"
#include "grove/registry/families.h"
#include "grove/registry/octree_statistics.h"
#include "grove/registry/update_by_rebuilding.h"
#include "grove/traverse/traceable_octree.h"

namespace grove {
namespace {

OctreeRSearch parse_search(const std::string& name) {
  if (name == "events") return OctreeRSearch::events;
  return name == "joint" ? OctreeRSearch::joint : OctreeRSearch::candidates;
}

struct OctreeOptions {
  explicit OctreeOptions(const Spec& spec) : walk(spec.value("walk") == "neighbour" ? OctreeWalk::neighbour : OctreeWalk::top_down) {
    settings.split = spec.value("split") == "octree-r" ? OctreeSplit::octree_r : OctreeSplit::median;
    settings.search = parse_search(spec.value("planes"));
    settings.candidate_count = static_cast<std::uint32_t>(spec.number("candidates"));
    settings.store = spec.value("store") == "inner" ? OctreeStore::inner : OctreeStore::leaf;
    settings.build = spec.value("build") == "merge" ? OctreeBuild::merge : OctreeBuild::subtree;
    if (settings.build == OctreeBuild::merge && settings.split == OctreeSplit::octree_r)
      throw UsageError(
          "structure 'octree': build=merge needs split=median; the planes of octree-r depend on all primitives, so subsets cannot have "
          "them");
    settings.most_depth = static_cast<std::uint32_t>(spec.number("max-depth"));
    settings.leaf_size = static_cast<std::uint32_t>(spec.number("leaf-size"));
    // Where each primitive is referenced once there is nothing to remember.
    const bool is_wanted = spec.value("mailbox") == "true" && settings.store == OctreeStore::leaf;
    mailbox = is_wanted ? UseMailbox::yes : UseMailbox::no;
  }

  OctreeSettings settings;
  OctreeWalk walk;
  UseMailbox mailbox;
};

template <Geometry G>
using OctreeState = StructureState<TraceableOctree<G>>;

template <Geometry G>
OctreeState<G> build_state(const G& geometry, const OctreeOptions& options) {
  const Timer timer;
  Octree tree = build_octree(geometry, options.settings);
  GROVE_ASSERT(tree.validate(geometry.size()).empty());
  TraceableOctree<G> structure(std::move(tree), geometry, options.walk, options.mailbox);
  const double seconds = timer.seconds();
  const Box bounds = structure.tree.bounds;
  return {std::move(structure), bounds, seconds, {}};
}

/// Updates one octree: locally where it is told what changed and that is not most of it, else by building anew.
template <Geometry G>
class OctreeFollower {
 public:
  explicit OctreeFollower(const OctreeOptions& options) : options_(options) {}

  UpdateReport operator()(OctreeState<G>& state, const G& geometry, const UpdateSettings& settings) {
    const Timer timer;
    if (is_worth_local(settings, geometry.size(), kLargestShare)) {
      std::optional<Octree> updated = update_octree(state.structure.tree, geometry, options_.settings, settings.changed);
      if (updated.has_value()) {
        GROVE_ASSERT(updated->validate(geometry.size()).empty());
        UpdateReport report;
        report.method = UpdateMethod::local;
        if (!built_cost_.has_value()) built_cost_ = cost_of(state);
        report.built_cost = *built_cost_;
        state.structure = TraceableOctree<G>(*std::move(updated), geometry, options_.walk, options_.mailbox);
        state.bounds = state.structure.tree.bounds;
        report.cost = cost_of(state);
        report.seconds = timer.seconds();
        return report;
      }
    }
    const std::optional<double> built_cost = std::exchange(built_cost_, std::nullopt);
    const auto measure = [](const OctreeState<G>& now) { return StructureMeasure{cost_of(now), now.structure.tree.references.size()}; };
    UpdateReport report = update_by_rebuilding(
        state, geometry, [&](const G& changed) { return build_state(changed, options_); }, measure);
    report.built_cost = built_cost.value_or(report.built_cost);
    return report;
  }

 private:
  // Local updates of more take about as long as building (docs/octree.md).
  static constexpr std::size_t kLargestShare = 4;

  OctreeOptions options_;
  /// Of the tree that was last built as a whole, once there have been local updates since.
  std::optional<double> built_cost_;
};

template <Geometry G>
std::unique_ptr<Accelerator> build_over(const Spec& spec, std::shared_ptr<const G> geometry) {
  const OctreeOptions options(spec);
  OctreeState<G> state = build_state(*geometry, options);
  return make_cell_tree_accelerator(spec.canonical(), std::move(state), std::move(geometry), OctreeFollower<G>(options));
}

}  // namespace

StructureFamily describe_octree() {
  return {"octree",
          "octree: cells cut in eight, each primitive in every cell that it reaches into or in the one that encloses it",
          {
              {"split",
               {"median", "octree-r"},
               0,
               0,
               0,
               "where cells are cut: in the middle, or where the fewest tests are expected (octree-R)"},
              {"store",
               {"leaf", "inner"},
               0,
               0,
               0,
               "where a primitive is referenced: in all leaves that it overlaps, or in the smallest node that encloses it"},
              {"walk",
               {"top-down", "neighbour"},
               0,
               0,
               0,
               "how a ray comes from leaf to leaf: down from the root, nearer octants first, or from cell to neighbouring cell"},
              {"build",
               {"subtree", "merge"},
               0,
               0,
               0,
               "how threads build the same tree: octants apart, from the root down; or subsets of the primitives apart, whose octrees are "
               "merged (split=median)"},
              {"mailbox",
               {"true", "false"},
               0,
               0,
               0,
               "whether a ray remembers what it was tested against, so as not to test it in the next cell again"},
              {"max-depth", {}, 0, 24, 0, "most cuts above a leaf; 0 for (8 + 1.3 log2 of the number of primitives) / 3"},
              {"leaf-size",
               {},
               0,
               64,
               0,
               "sets of at most this many primitives are not cut; 0 for 8, and for octree-r, where the cost decides, for 1"},
              {"planes",
               {"candidates", "events", "joint"},
               0,
               0,
               0,
               "octree-r: tries planes between the medians, or all in which primitives begin or end, for each axis; or planes of the three "
               "axes together"},
              {"candidates", {}, 1, 64, 8, "octree-r: planes tried for each axis between the medians, at most 16 with planes=joint"},
          },
          {{"octree-r", "split", "octree-r"}}};
}

std::unique_ptr<Accelerator> build_octree(const Spec& spec, const GeometryPointer& geometry) {
  return std::visit([&](const auto& set) { return build_over(spec, set); }, geometry);
}

}  // namespace grove
