#include "grove/lab/structure_trial.h"

#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <numeric>

#include "grove/base/error.h"
#include "grove/base/timer.h"
#include "grove/lab/pinned.h"
#include "grove/render/scene_accelerator.h"

namespace grove {
namespace {

/// A round takes at least this long, by tracing the same rays again, so that the clock's steps do not show.
constexpr double kShortestRound = 0.02;

class Trials {
 public:
  Trials(const Scene& scene, std::span<const std::string> specs, std::span<const Ray> rays, const TrialSettings& settings)
      : scene_(scene), rays_(rays), settings_(settings), hits_(rays.size()), trials_(specs.size()), structures_(specs.size()) {
    for (std::size_t i = 0; i < specs.size(); ++i) trials_[i].structure = canonical_spec(specs[i]);
  }

  std::vector<StructureTrial> run() {
    for (unsigned round = 0; round < settings_.build_rounds; ++round) {
      for (std::size_t i = 0; i < trials_.size(); ++i) build(i);
    }
    for (std::size_t i = 0; i < trials_.size(); ++i) count(i);
    with_threads(settings_.threads, [&] {
      for (unsigned round = 0; round < settings_.rounds; ++round) {
        for (std::size_t i = 0; i < trials_.size(); ++i) time(i);
      }
    });
    return std::move(trials_);
  }

 private:
  void check_stop() const {
    if (settings_.stop.stop_requested()) throw Stopped();
  }

  template <typename Work>
  static void with_threads(unsigned threads, const Work& work) {
    oneapi::tbb::task_arena arena(static_cast<int>(threads));
    std::unique_ptr<Pinned> pinned;
    if (threads == 1) pinned = std::make_unique<Pinned>();
    arena.execute(work);
  }

  void build(std::size_t i) {
    check_stop();
    structures_[i].reset();
    const auto build_now = [&] {
      const Timer timer;
      structures_[i] = std::make_unique<SceneAccelerator>(scene_, trials_[i].structure);
      trials_[i].build_seconds.push_back(timer.seconds());
    };
    if (settings_.build_threads == 0) {
      build_now();
    } else {
      with_threads(settings_.build_threads, build_now);
    }
    trials_[i].statistics = structures_[i]->statistics();
  }

  void count(std::size_t i) {
    check_stop();
    const TraversalCounts counts = trace_counted(structures_[i]->top(), settings_.query, rays_, hits_);
    if (i == 0) expected_ = hits_;
    const auto mismatches = std::inner_product(hits_.begin(), hits_.end(), expected_.begin(), std::size_t{0}, std::plus<>(),
                                               [](const Hit& a, const Hit& b) { return same_bits(a, b) ? 0 : 1; });
    if (mismatches > 0) {
      throw Error(scene_.name + ": " + std::to_string(mismatches) + " hits of " + trials_[i].structure + " are not those of " +
                  trials_.front().structure);
    }
    const auto ray_count = static_cast<double>(std::max<std::size_t>(1, rays_.size()));
    trials_[i].nodes = static_cast<double>(counts.nodes_visited) / ray_count;
    trials_[i].tests = static_cast<double>(counts.primitives_tested) / ray_count;
  }

  void time(std::size_t i) {
    check_stop();
    const Timer timer;
    std::size_t repeats = 0;
    do {
      trace(structures_[i]->top(), settings_.query, rays_, hits_);
      ++repeats;
    } while (timer.seconds() < kShortestRound);
    trials_[i].nanoseconds.push_back(1e9 * timer.seconds() / static_cast<double>(repeats * std::max<std::size_t>(1, rays_.size())));
  }

  const Scene& scene_;
  std::span<const Ray> rays_;
  const TrialSettings& settings_;
  std::vector<Hit> hits_;
  std::vector<Hit> expected_;
  std::vector<StructureTrial> trials_;
  std::vector<std::unique_ptr<SceneAccelerator>> structures_;
};

}  // namespace

std::vector<StructureTrial> try_structures(const Scene& scene, std::span<const std::string> specs, std::span<const Ray> rays,
                                           const TrialSettings& settings) {
  return Trials(scene, specs, rays, settings).run();
}

std::vector<double> ratios_by_round(std::span<const double> other, std::span<const double> base) {
  std::vector<double> ratios;
  ratios.reserve(base.size());
  for (std::size_t round = 0; round < std::min(other.size(), base.size()); ++round) ratios.push_back(other[round] / base[round]);
  return ratios;
}

}  // namespace grove
