#include "grove/lab/comparison.h"

#include <algorithm>
#include <exception>
#include <new>
#include <optional>
#include <span>

#include "grove/base/error.h"
#include "grove/base/timer.h"
#include "grove/lab/reference.h"

namespace grove {
namespace {

/// Brute force traces as many rays of each kind as make about this many tests: a tenth of a second on one thread.
constexpr std::uint64_t kBruteTests = 10'000'000;
/// It is in the default list where that is at least this many rays.
constexpr std::uint64_t kFewestBruteRays = 1000;
/// A rate is measured over at least this long, by tracing the same rays again, so that the clock's steps do not show.
constexpr double kShortestMeasurement = 0.02;

/// The rays of one kind, and the right hits.
struct Workload {
  RayKind kind;
  std::vector<Ray> rays;
  std::vector<Ray> sample;  // every brute_stride_-th of them, where that is not 1
  std::string error;        // why there are none
  std::optional<Reference> reference;
};

/// What is known about one structure: a row for each workload, and the measurements that its rows will be made from.
struct Contender {
  std::string spec;
  std::string error;
  std::size_t stride = 1;  // it traces every stride-th ray
  std::vector<double> build_seconds;
  std::vector<ComparisonRow> rows;
  std::vector<std::vector<double>> rates;  // of each workload, by round; 0 where the round gave none
};

std::string reason(const std::exception& exception) {
  return dynamic_cast<const std::bad_alloc*>(&exception) != nullptr ? "out of memory" : exception.what();
}

/// One run of `compare`.
class Run {
 public:
  Run(const Scene& scene, const ComparisonSettings& settings, const ProgressReporter& progress)
      : scene_(scene), settings_(settings), progress_(progress) {}

  Comparison run() {
    Comparison comparison;
    comparison.scene = scene_.name;
    comparison.primitives = scene_.primitive_count();
    comparison.ray_count = settings_.workload.ray_count;
    comparison.machine = describe_machine();
    prepare_contenders(comparison.notes);
    // Each kind of rays is traced once for the reference, then by each structure to be checked and in each round.
    rays_to_trace_ = settings_.rays.size() * settings_.workload.ray_count * (1 + contenders_.size() * (1 + settings_.rounds));
    prepare_workloads();
    for (Contender& contender : contenders_) check(contender);
    unsigned rounds = 0;
    while (rounds < settings_.rounds && !progress_.stop.stop_requested()) {
      for (Contender& contender : contenders_) time(contender);
      if (!progress_.stop.stop_requested()) ++rounds;
    }
    comparison.rounds = rounds;
    for (const Workload& workload : workloads_) {
      if (workload.reference) comparison.reference_rays = workload.reference->sampled_count();
    }
    collect(comparison.rows);
    return comparison;
  }

 private:
  /// One kind of rays was traced by one structure, or turned out to be impossible.
  void step() {
    rays_traced_ += settings_.workload.ray_count;
    if (progress_.report) progress_.report(rays_traced_, rays_to_trace_);
  }

  void prepare_contenders(std::vector<std::string>& notes) {
    std::vector<std::string> specs = settings_.structures;
    if (specs.empty()) specs = default_specs(scene_.primitive_count(), notes);
    const std::uint64_t brute_rays = std::max<std::uint64_t>(1, kBruteTests / std::max<std::uint64_t>(1, scene_.primitive_count()));
    brute_stride_ = (settings_.workload.ray_count + brute_rays - 1) / brute_rays;
    for (const std::string& spec : specs) {
      Contender contender;
      contender.spec = canonical_spec(spec);
      contender.stride = contender.spec == "brute" ? brute_stride_ : 1;
      contender.rates.resize(settings_.rays.size());
      for (const RayKind kind : settings_.rays) {
        ComparisonRow row;
        row.structure = contender.spec;
        row.rays = kind;
        row.ray_count = (settings_.workload.ray_count + contender.stride - 1) / contender.stride;
        contender.rows.push_back(row);
      }
      contenders_.push_back(std::move(contender));
    }
  }

  /// Makes the rays and finds out what they hit.
  void prepare_workloads() {
    const Camera camera = workload_camera(scene_, settings_.camera);
    const SceneAccelerator accelerator(scene_, kDefaultSpec);
    const SceneAccelerator brute(scene_, "brute");
    for (const RayKind kind : settings_.rays) {
      Workload& workload = workloads_.emplace_back();
      workload.kind = kind;
      try {
        workload.rays = make_rays(kind, scene_, accelerator, camera, settings_.workload);
        if (brute_stride_ > 1) {
          for (std::size_t i = 0; i < workload.rays.size(); i += brute_stride_) workload.sample.push_back(workload.rays[i]);
        }
        workload.reference.emplace(brute.top(), scene_.primitive_count(), query_of(kind), workload.rays, settings_.check_budget);
      } catch (const std::exception& exception) {
        workload.error = reason(exception);
      }
      step();
      if (progress_.stop.stop_requested()) return;
    }
  }

  /// Builds once, checks every hit and counts what each ray does. What is wrong is not timed.
  void check(Contender& contender) {
    if (progress_.stop.stop_requested()) return;
    try {
      const SceneAccelerator accelerator(scene_, contender.spec);
      const StructureQuality quality = accelerator.measure_quality();
      for (std::size_t i = 0; i < workloads_.size(); ++i) {
        Workload& workload = workloads_[i];
        ComparisonRow& row = contender.rows[i];
        describe_structure(accelerator.statistics(), quality, row);
        row.error = workload.error;
        if (workload.error.empty()) check(accelerator.top(), workload, contender.stride, row);
        step();
      }
    } catch (const std::exception& exception) {
      contender.error = reason(exception);
    }
  }

  static std::span<const Ray> rays_of(const Workload& workload, std::size_t stride) {
    return stride == 1 ? workload.rays : workload.sample;
  }

  static void check(const Accelerator& accelerator, Workload& workload, std::size_t stride, ComparisonRow& row) {
    const std::span<const Ray> rays = rays_of(workload, stride);
    std::vector<Hit> hits(rays.size());
    const TraversalCounts counts = trace_counted(accelerator, query_of(workload.kind), rays, hits);
    const auto ray_count = static_cast<double>(hits.size());
    row.nodes_per_ray = static_cast<double>(counts.nodes_visited) / ray_count;
    row.tests_per_ray = static_cast<double>(counts.primitives_tested) / ray_count;
    row.mismatches = workload.reference->count_mismatches(hits, stride);
    if (row.mismatches > 0) {
      row.error = std::to_string(row.mismatches) + " of " + std::to_string(hits.size()) + " hits are not the reference's";
    }
  }

  /// Builds once more and traces each workload, for the clock.
  void time(Contender& contender) {
    if (progress_.stop.stop_requested()) return;
    if (contender.error.empty()) {
      try {
        const Timer timer;
        const SceneAccelerator accelerator(scene_, contender.spec);
        contender.build_seconds.push_back(timer.seconds());
        for (std::size_t i = 0; i < workloads_.size(); ++i) {
          contender.rates[i].push_back(contender.rows[i].error.empty()
                                           ? rate(accelerator.top(), workloads_[i].kind, rays_of(workloads_[i], contender.stride))
                                           : 0.0);
          step();
        }
      } catch (const std::exception& exception) {
        contender.error = reason(exception);
      }
    }
  }

  /// Millions of rays a second.
  double rate(const Accelerator& accelerator, RayKind kind, std::span<const Ray> rays) {
    hits_.resize(rays.size());
    const Timer timer;
    std::size_t repeats = 0;
    do {
      trace(accelerator, query_of(kind), rays, hits_);
      ++repeats;
    } while (timer.seconds() < kShortestMeasurement);
    return 1e-6 * static_cast<double>(repeats * rays.size()) / timer.seconds();
  }

  void collect(std::vector<ComparisonRow>& rows) const {
    for (std::size_t i = 0; i < workloads_.size(); ++i) {
      for (const Contender& contender : contenders_) {
        ComparisonRow& row = rows.emplace_back(contender.rows[i]);
        if (!contender.error.empty()) row.error = contender.error;
        row.build_seconds = spread_of(contender.build_seconds);
        if (!row.error.empty()) continue;
        row.mrays_per_s = spread_of(contender.rates[i]);
        row.ratio_to_first = spread_of(ratios(contender.rates[i], contenders_.front().rates[i]));
      }
    }
  }

  /// Round by round; the rounds that both have.
  static std::vector<double> ratios(std::span<const double> rates, std::span<const double> first) {
    std::vector<double> result;
    for (std::size_t round = 0; round < std::min(rates.size(), first.size()); ++round) {
      if (first[round] > 0.0) result.push_back(rates[round] / first[round]);
    }
    return result;
  }

  const Scene& scene_;
  const ComparisonSettings& settings_;
  const ProgressReporter& progress_;
  std::vector<Contender> contenders_;
  std::vector<Workload> workloads_;
  std::vector<Hit> hits_;
  std::size_t brute_stride_ = 1;
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

Comparison compare(const Scene& scene, const ComparisonSettings& settings, const ProgressReporter& progress) {
  return Run(scene, settings, progress).run();
}

}  // namespace grove
