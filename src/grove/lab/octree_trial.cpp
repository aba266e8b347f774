#include "grove/lab/octree_trial.h"

#include <cmath>
#include <utility>
#include <variant>

#include "grove/base/check.h"
#include "grove/base/error.h"
#include "grove/base/timer.h"
#include "grove/build/octree/build_octree.h"
#include "grove/build/octree/update_octree.h"
#include "grove/lab/octree_links.h"
#include "grove/lab/regression.h"
#include "grove/lab/spread.h"

namespace grove {
namespace {

template <Geometry G>
class Trials {
 public:
  Trials(const G& geometry, std::span<const OctreeContender> contenders, std::span<const Ray> rays) : geometry_(geometry), rays_(rays) {
    for (const OctreeContender& contender : contenders) add(contender);
  }

  std::vector<OctreeTrial> run(unsigned rounds) {
    const auto ray_count = static_cast<double>(rays_.size());
    for (unsigned round = 0; round < rounds; ++round) {
      for (std::size_t i = 0; i < structures_.size(); ++i) {
        const Timer timer;
        double sum = 0.0;
        for (const Ray& ray : rays_) sum += trace(structures_[i], links_[i], ray, NoCounter()).t < 1.0F ? 1.0 : 0.0;
        trials_[i].nanoseconds.push_back(1e9 * timer.seconds() / ray_count);
        // Used, so that nothing is left out.
        GROVE_CHECK(sum <= ray_count);
      }
    }
    return std::move(trials_);
  }

 private:
  template <typename C>
  Hit trace(const TraceableOctree<G>& structure, const OctreeLinks& links, const Ray& ray, C counter) const {
    Hit hit;
    hit.t = ray.t_max;
    if (links.cells.empty()) {
      trace_closest(structure, geometry_, ray, hit, counter);
    } else {
      const auto walk_leaves = [&](const float& t_max, const auto& leaf) {
        walk_by_links(structure.tree, links, ray, t_max, leaf, counter);
      };
      trace_closest_in_leaves(geometry_, structure.leaves, structure.tree.references.data(), structure.mailbox, ray, hit, walk_leaves,
                              counter);
    }
    return hit;
  }

  void add(const OctreeContender& contender) {
    OctreeTrial trial;
    trial.name = contender.name;
    const Timer timer;
    Octree tree = build_octree(geometry_, contender.settings);
    trial.build_seconds = timer.seconds();
    trial.nodes = tree.nodes.size();
    trial.leaves = tree.leaf_count();
    trial.references = tree.references.size();
    trial.bytes = tree.memory();
    GROVE_CHECK(!contender.has_links || contender.settings.store == OctreeStore::leaf);
    links_.push_back(contender.has_links ? link_octree(tree) : OctreeLinks());
    trial.bytes += links_.back().memory();
    structures_.emplace_back(std::move(tree), geometry_, contender.walk, contender.mailbox);
    TraversalCounts counts;
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      const Hit hit = trace(structures_.back(), links_.back(), rays_[i], Counter(counts));
      if (structures_.size() == 1) expected_.push_back(hit.primitive);
      GROVE_CHECK(hit.primitive == expected_[i]);
    }
    const auto ray_count = static_cast<double>(rays_.size());
    trial.nodes_visited = static_cast<double>(counts.nodes_visited) / ray_count;
    trial.leaves_entered = static_cast<double>(counts.leaves_entered) / ray_count;
    trial.tests = static_cast<double>(counts.primitives_tested) / ray_count;
    trials_.push_back(std::move(trial));
  }

  const G& geometry_;
  std::span<const Ray> rays_;
  std::vector<TraceableOctree<G>> structures_;
  std::vector<OctreeLinks> links_;
  std::vector<OctreeTrial> trials_;
  std::vector<std::uint32_t> expected_;
};

}  // namespace

std::vector<OctreeTrial> try_octrees(const GeometryPointer& geometry, std::span<const OctreeContender> contenders,
                                     std::span<const Ray> rays, unsigned rounds) {
  return std::visit(
      [&](const auto& set) {
        using G = std::remove_cvref_t<decltype(*set)>;
        return Trials<G>(*set, contenders, rays).run(rounds);
      },
      geometry);
}

OctreeUpdateTrial try_octree_update(const GeometryPointer& before, const GeometryPointer& after, std::span<const std::uint32_t> moved,
                                    const OctreeSettings& settings, unsigned rounds) {
  const Octree tree = std::visit([&](const auto& set) { return build_octree(*set, settings); }, before);
  OctreeUpdateTrial trial;
  for (unsigned round = 0; round < rounds; ++round) {
    std::visit(
        [&](const auto& set) {
          const Timer update_timer;
          const std::optional<Octree> updated = update_octree(tree, *set, settings, moved);
          trial.update_seconds.push_back(update_timer.seconds());
          if (!updated.has_value()) throw InputError("the octree cannot follow: its root does not fit any more");
          const Timer build_timer;
          const Octree built = build_octree(*set, settings);
          trial.build_seconds.push_back(build_timer.seconds());
        },
        after);
  }
  return trial;
}

std::uint64_t count_octree_leaves(const GeometryPointer& geometry, const OctreeSettings& settings) {
  return std::visit([&](const auto& set) -> std::uint64_t { return build_octree(*set, settings).leaf_count(); }, geometry);
}

OctreeSettings match_leaves(const GeometryPointer& geometry, OctreeSettings settings, std::uint64_t leaves, int builds) {
  // The dearer a step, the fewer leaves. Looked for between a fiftieth of the usual time and twenty times as much, by halving on a scale of powers.
  double low = 0.02;
  double high = 20.0;
  double best_error = std::numeric_limits<double>::infinity();
  OctreeSettings best = settings;
  for (int i = 0; i < builds; ++i) {
    settings.cost.traversal = std::sqrt(low * high);
    const std::uint64_t found = count_octree_leaves(geometry, settings);
    const double error = std::fabs(std::log(static_cast<double>(found) / static_cast<double>(leaves)));
    if (error < best_error) {
      best_error = error;
      best = settings;
    }
    (found > leaves ? low : high) = settings.cost.traversal;
  }
  return best;
}

Equation5 fit_equation_5(std::span<const OctreeTrial> trials) {
  std::vector<double> causes;
  std::vector<double> times;
  causes.reserve(3 * trials.size());
  times.reserve(trials.size());
  for (const OctreeTrial& trial : trials) {
    causes.insert(causes.end(), {1.0, trial.nodes_visited, trial.tests});
    times.push_back(spread_of(trial.nanoseconds).median);
  }
  const LinearFit fit = fit_linear(causes, 3, times);
  return {fit.prices[0], fit.prices[1], fit.prices[2], fit.r_squared};
}

}  // namespace grove
