#include "grove/lab/scale_study.h"

#include <algorithm>
#include <map>
#include <optional>

#include "grove/base/error.h"
#include "grove/base/timer.h"
#include "grove/lab/ray_set.h"
#include "grove/lab/structure_trial.h"
#include "grove/lab/utc_date.h"
#include "grove/scene/load.h"

namespace grove {
namespace {

/// A rate is measured over at least this long.
constexpr double kShortestMeasurement = 0.02;
/// Where building and tracing once takes longer than this, once is enough: it varies less, and takes patience.
constexpr double kLongTurn = 5.0;
/// Brute force traces as many rays as make about this many tests.
constexpr std::uint64_t kBruteTests = 20'000'000;

/// The scene with that many primitives.
std::string sized(const std::string& scene, std::uint64_t primitives) {
  const char separator = scene.find('?') == std::string::npos ? '?' : '&';
  return scene + separator + "primitives=" + std::to_string(primitives);
}

/// One structure at one size, while it is measured.
struct Turn {
  std::string spec;
  ScaleRow row;
  std::vector<double> build_seconds;
  std::vector<double> rates;
  bool is_long = false;
};

class ScaleRun {
 public:
  ScaleRun(const ScaleSettings& settings, const std::function<void(const ScaleStudy&)>& save, const ProgressReporter& progress)
      : settings_(settings), save_(save), progress_(progress) {}

  ScaleStudy run() {
    if (!settings_.scene.starts_with("builtin:"))
      throw UsageError("'" + settings_.scene + "' cannot be made in other sizes; name a built-in scene, such as builtin:mount");
    for (const std::string& spec : settings_.structures) specs_.push_back(canonical_spec(spec));
    study_.scene = settings_.scene;
    study_.sizes = settings_.sizes;
    study_.rays = name_of(settings_.rays);
    study_.ray_count = settings_.workload.ray_count;
    study_.machine = describe_machine();
    study_.command = settings_.command;
    try {
      for (std::size_t i = 0; i < settings_.sizes.size(); ++i) {
        measure(settings_.sizes[i]);
        study_.fits = fit();
        study_.date = utc_date();
        study_.is_complete = i + 1 == settings_.sizes.size();
        if (save_) save_(study_);
      }
    } catch (const Stopped&) {
      // The sizes that are finished are kept.
    }
    study_.date = utc_date();
    return std::move(study_);
  }

 private:
  void check_stop() const {
    if (progress_.stop.stop_requested()) throw Stopped();
  }

  void step() {
    ++done_;
    if (progress_.report) progress_.report(done_, settings_.sizes.size() * specs_.size());
  }

  void measure(std::uint64_t size) {
    check_stop();
    const std::string name = sized(settings_.scene, size);
    const Scene scene = load_scene(name);
    RaySet rays;
    {
      const SceneAccelerator accelerator(scene, kDefaultSpec);
      rays = ray_set(study_.rays, make_rays(settings_.rays, scene, accelerator, workload_camera(scene, ""), settings_.workload),
                     query_of(settings_.rays));
    }
    const std::uint64_t primitives = scene.primitive_count();
    const std::size_t brute_stride = std::max<std::size_t>(1, rays.size() / std::max<std::uint64_t>(1, kBruteTests / primitives));
    const RaySet some = rays.every(brute_stride);
    std::vector<Turn> turns;
    expected_.clear();
    for (const std::string& spec : specs_) {
      Turn& turn = turns.emplace_back();
      turn.spec = spec;
      turn.row.structure = spec;
      turn.row.primitives = primitives;
    }
    for (unsigned round = 0; round < settings_.rounds; ++round) {
      for (Turn& turn : turns) {
        const bool is_brute = turn.spec == "brute";
        take(turn, name, scene, is_brute ? some : rays, is_brute ? brute_stride : 1);
        if (round == 0) step();
      }
    }
    for (Turn& turn : turns) {
      turn.row.build_seconds = spread_of(turn.build_seconds);
      turn.row.mrays_per_s = spread_of(turn.rates);
      study_.rows.push_back(std::move(turn.row));
    }
  }

  /// Builds and traces once; counts and checks the first time.
  void take(Turn& turn, const std::string& name, const Scene& scene, const RaySet& rays, std::size_t stride) {
    check_stop();
    if (turn.is_long || !turn.row.error.empty()) return;
    const bool is_first = turn.build_seconds.empty();
    try {
      if (const auto known = failed_.find(turn.spec); known != failed_.end()) throw Error(known->second);
      if (is_first && settings_.trial_build) {
        if (const std::string reason = settings_.trial_build(name, turn.spec); !reason.empty()) throw Error(reason);
      }
      const Timer timer;
      const SceneAccelerator accelerator(scene, turn.spec);
      turn.build_seconds.push_back(timer.seconds());
      if (is_first) count(turn, accelerator, rays, stride);
      turn.rates.push_back(rate(accelerator.top(), rays));
      turn.is_long = timer.seconds() > kLongTurn;
    } catch (const std::exception& exception) {
      turn.row.error = reason_of(exception);
      failed_.emplace(turn.spec, "not tried, as it failed at a smaller size: " + turn.row.error);
    }
  }

  void count(Turn& turn, const SceneAccelerator& accelerator, const RaySet& rays, std::size_t stride) {
    const Query query = query_of(settings_.rays);
    std::vector<Hit> hits(rays.size());
    const TraversalCounts counts = trace_counted(accelerator.top(), query, rays.rays, hits);
    const auto ray_count = static_cast<double>(std::max<std::size_t>(1, rays.size()));
    turn.row.nodes = static_cast<double>(counts.nodes_visited) / ray_count;
    turn.row.tests = static_cast<double>(counts.primitives_tested) / ray_count;
    turn.row.bytes = accelerator.statistics().bytes;
    if (stride == 1 && expected_.empty()) expected_ = hits;
    if (expected_.empty()) return;
    std::size_t mismatches = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) mismatches += same_bits(hits[i], expected_[i * stride]) ? 0 : 1;
    if (mismatches > 0)
      throw Error(std::to_string(mismatches) + " of " + std::to_string(hits.size()) + " hits are not those of the first structure");
  }

  /// Millions of rays a second.
  static double rate(const Accelerator& accelerator, const RaySet& rays) {
    std::vector<Hit> hits(rays.size());
    const Timer timer;
    std::size_t repeats = 0;
    do {
      trace(accelerator, rays, hits);
      ++repeats;
    } while (timer.seconds() < kShortestMeasurement);
    return 1e-6 * static_cast<double>(repeats * rays.size()) / timer.seconds();
  }

  [[nodiscard]] std::vector<ScaleFit> fit() const {
    std::vector<ScaleFit> fits;
    for (const std::string& spec : specs_) {
      std::vector<double> sizes;
      std::vector<double> build;
      std::vector<double> memory;
      std::vector<double> steps;
      for (const ScaleRow& row : study_.rows) {
        if (row.structure != spec || !row.error.empty()) continue;
        sizes.push_back(static_cast<double>(row.primitives));
        build.push_back(row.build_seconds.median);
        memory.push_back(static_cast<double>(row.bytes));
        steps.push_back(row.steps());
      }
      if (sizes.size() < 2 || sizes.front() == sizes.back()) continue;
      const auto law = [&](std::span<const double> figures) {
        const bool has_law = std::ranges::all_of(figures, [](double figure) { return figure > 0.0; });
        return has_law ? fit_power_law(sizes, figures) : PowerLaw{};
      };
      fits.push_back({spec, law(build), law(memory), law(steps)});
    }
    return fits;
  }

  const ScaleSettings& settings_;
  const std::function<void(const ScaleStudy&)>& save_;
  const ProgressReporter& progress_;
  ScaleStudy study_;
  std::vector<std::string> specs_;
  std::vector<Hit> expected_;  // of the first structure that traces all rays
  std::map<std::string, std::string> failed_;
  std::uint64_t done_ = 0;
};

}  // namespace

std::vector<std::uint64_t> scale_sizes(std::uint64_t largest) {
  std::vector<std::uint64_t> sizes;
  for (std::uint64_t decade = 1000; decade <= largest; decade *= 10) {
    sizes.push_back(decade);
    if (3 * decade <= largest) sizes.push_back(3 * decade);
  }
  return sizes;
}

std::vector<std::string> scale_specs() {
  return {"bvh", "bvh:split=lbvh", "bvh:arity=8", "fast", "kdtree", "octree"};
}

ScaleStudy study_scale(const ScaleSettings& settings, const std::function<void(const ScaleStudy&)>& save,
                       const ProgressReporter& progress) {
  return ScaleRun(settings, save, progress).run();
}

}  // namespace grove
