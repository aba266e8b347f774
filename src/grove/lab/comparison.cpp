#include "grove/lab/comparison.h"

#include <algorithm>
#include <limits>

#include "grove/base/error.h"
#include "grove/lab/auto_choice.h"
#include "grove/lab/comparison_workload.h"
#include "grove/lab/contender.h"
#include "grove/lab/structure_trial.h"
#include "grove/lab/utc_date.h"

namespace grove {
namespace {

/// Brute force is in the default list where it traces at least this many rays.
constexpr std::uint64_t kFewestBruteRays = 1000;

/// One run of `compare`.
class Run {
 public:
  Run(const Scene& scene, const ComparisonSettings& settings, const ProgressReporter& progress,
      const std::function<void(const Comparison&)>& save)
      : scene_(scene), settings_(settings), progress_(progress), save_(save) {}

  Comparison run() {
    result_.scene = scene_.name;
    result_.primitives = scene_.primitive_count();
    result_.instances = scene_.instances.size();
    result_.ray_count = settings_.workload.ray_count;
    result_.machine = describe_machine();
    result_.command = settings_.command;
    for (const std::string& spec : chosen_specs()) specs_.push_back(canonical_spec(spec));
    result_.auto_choice = auto_choice(scene_, "auto");
    prepare_workloads();
    for (const std::string& spec : specs_) contenders_.emplace_back(spec, workloads_);
    check_all();
    while (result_.rounds < settings_.rounds && !is_stopped()) {
      for (Contender& contender : contenders_) {
        if (!is_stopped()) contender.time(scene_, workloads_, [this](const ComparisonWorkload& workload) { step(workload.set.size()); });
      }
      if (is_stopped()) break;
      ++result_.rounds;
      result_.is_complete = result_.rounds == settings_.rounds;
      if (!result_.is_complete) save_so_far();
    }
    collect();
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool is_stopped() const { return progress_.stop.stop_requested(); }

  std::vector<std::string> chosen_specs() {
    return settings_.structures.empty() ? default_specs(scene_.primitive_count(), result_.notes) : settings_.structures;
  }

  /// Some rays were traced by one structure, or turned out to be impossible.
  void step(std::uint64_t rays) {
    rays_traced_ += rays;
    if (progress_.report) progress_.report(std::min(rays_traced_, rays_to_trace_), rays_to_trace_);
  }

  void prepare_workloads() {
    // Each kind of rays is traced once for the reference, then by each structure to be checked and in each round.
    const std::uint64_t turns = specs_.size() * (1 + settings_.rounds);
    const std::uint64_t per_kind = settings_.workload.ray_count;
    rays_to_trace_ = settings_.rays.size() * per_kind * (1 + turns);
    const auto made = [&] {
      step(per_kind);
      return !is_stopped();
    };
    workloads_ = make_workloads(scene_, {settings_.rays, settings_.workload, settings_.camera, settings_.check_budget}, made);
    // Recorded rays may be more or fewer.
    std::uint64_t rays = 0;
    for (const ComparisonWorkload& workload : workloads_) rays += workload.set.size();
    rays_to_trace_ = rays_traced_ + rays * turns;
    result_.reference_rays = std::numeric_limits<std::uint64_t>::max();
    for (const ComparisonWorkload& workload : workloads_) {
      if (workload.reference && workload.set.size() == settings_.workload.ray_count)
        result_.reference_rays = std::min(result_.reference_rays, workload.reference->sampled_count());
    }
    if (result_.reference_rays == std::numeric_limits<std::uint64_t>::max()) result_.reference_rays = settings_.workload.ray_count;
  }

  void check_all() {
    const Camera camera = workload_camera(scene_, settings_.camera);
    ContenderCheck check;
    check.trial_build = settings_.trial_build;
    check.time_limit = settings_.time_limit;
    check.heat_map_camera = settings_.heat_maps ? &camera : nullptr;
    check.traced = [this](const ComparisonWorkload& workload) { step(workload.set.size()); };
    for (Contender& contender : contenders_) {
      if (is_stopped()) return;
      try {
        contender.check(scene_, workloads_, check);
      } catch (const Stopped&) {
        return;
      }
      save_so_far();
    }
  }

  void save_so_far() {
    if (!save_) return;
    collect();
    save_(result_);
  }

  void collect() {
    result_.rows.clear();
    result_.heat_maps.clear();
    for (std::size_t i = 0; i < workloads_.size(); ++i) {
      for (const Contender& contender : contenders_) {
        if (std::optional<ComparisonRow> row = contender.row(i, contenders_.front())) result_.rows.push_back(std::move(*row));
      }
    }
    for (const Contender& contender : contenders_) {
      if (contender.heat_map()) result_.heat_maps.push_back(*contender.heat_map());
    }
    result_.date = utc_date();
  }

  const Scene& scene_;
  const ComparisonSettings& settings_;
  const ProgressReporter& progress_;
  const std::function<void(const Comparison&)>& save_;
  Comparison result_;
  std::vector<std::string> specs_;
  std::vector<ComparisonWorkload> workloads_;
  std::vector<Contender> contenders_;
  std::uint64_t rays_traced_ = 0;
  std::uint64_t rays_to_trace_ = 0;
};

}  // namespace

std::vector<std::string> default_specs(std::uint64_t primitive_count, std::vector<std::string>& notes) {
  std::vector<std::string> specs;
  for (const std::string_view spec : representative_specs()) {
    if (spec == "brute" && primitive_count > kBruteTests / kFewestBruteRays) {
      notes.push_back("brute is left out, as it would take long on " + std::to_string(primitive_count) +
                      " primitives; name it among the structures to have it");
      continue;
    }
    specs.emplace_back(spec);
  }
  return specs;
}

Comparison compare(const Scene& scene, const ComparisonSettings& settings, const ProgressReporter& progress,
                   const std::function<void(const Comparison&)>& save) {
  return Run(scene, settings, progress, save).run();
}

}  // namespace grove
