#include "rivals/measurement.h"

#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <ctime>
#include <thread>

#include "grove/base/timer.h"
#include "grove/lab/pinned.h"
#include "grove/scene/load.h"
#include "trace/agreement.h"
#include "trace/world_mesh.h"

namespace grove::bench::rivals {
namespace {

// Rivals may differ from Grove in this share of rays: at edges, where tests round differently, and by missing what lies between triangles.
constexpr double kMostDiffering = 2e-3;
// What one thread takes at a time when all trace.
constexpr std::size_t kPiece = 4096;

using Entrants = std::vector<std::unique_ptr<Entrant>>;

Entrants make_contenders(const std::shared_ptr<const TriangleMesh>& mesh, const std::vector<std::string>& structures) {
  Entrants all;
  for (const std::string& spec : structures) all.push_back(make_grove(mesh, spec, {1, 8, 32, 256, 1024}));
  all.push_back(make_grove(mesh, "bvh", {1}));
  for (const char* const isa : {"", "avx2"})
    for (const auto quality : {EmbreeSettings::Quality::medium, EmbreeSettings::Quality::high})
      for (const bool is_robust : {false, true}) all.push_back(make_embree(mesh, {quality, is_robust, isa}));
  return all;
}

struct Answers {
  explicit Answers(std::size_t count) : hits(count), occluded(count) {}
  std::vector<Hit> hits;
  std::vector<std::uint8_t> occluded;
};

void trace_range(const Entrant& contender, const Way& way, std::span<const Ray> rays, Answers& answers, std::size_t first,
                 std::size_t count) {
  if (query_of(way.kind) == Query::closest) {
    contender.intersect(way.call_size, way.kind == RayKind::primary, rays.subspan(first, count),
                        std::span(answers.hits).subspan(first, count));
  } else {
    contender.occluded(way.call_size, rays.subspan(first, count), std::span(answers.occluded).subspan(first, count));
  }
}

// Processor time of the calling thread: what else the machine does counts for less.
double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double trace_seconds(const Entrant& contender, const Way& way, std::span<const Ray> rays, Answers& answers, int threads) {
  if (threads == 1) {
    const double start = thread_seconds();
    trace_range(contender, way, rays, answers, 0, rays.size());
    return thread_seconds() - start;
  }
  const Timer timer;
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t first = next.fetch_add(kPiece); first < rays.size(); first = next.fetch_add(kPiece))
      trace_range(contender, way, rays, answers, first, std::min(kPiece, rays.size() - first));
  };
  std::vector<std::jthread> others;
  others.reserve(static_cast<std::size_t>(threads) - 1);
  for (int i = 1; i < threads; ++i) others.emplace_back(work);
  work();
  others.clear();  // waits for them
  return timer.seconds();
}

void measure_builds(const Entrants& contenders, const MeasureSettings& settings, SceneResult& result) {
  std::vector<int> counts = {1};
  if (settings.threads > 1) counts.push_back(settings.threads);
  for (const int threads : counts) {
    std::vector<BuildTime> times;
    times.reserve(contenders.size());
    for (const auto& contender : contenders) times.push_back({contender->traits(), threads, {}, 0.0});
    oneapi::tbb::task_arena arena(threads);
    for (int round = 0; round < settings.build_rounds; ++round) {
      for (std::size_t i = 0; i < contenders.size(); ++i) {
        double seconds = 0.0;
        if (threads == 1) {
          const Pinned pinned;
          arena.execute([&] { seconds = contenders[i]->build(); });
        } else {
          arena.execute([&] { seconds = contenders[i]->build(); });
        }
        times[i].seconds.push_back(seconds);
      }
    }
    for (std::size_t i = 0; i < contenders.size(); ++i)
      times[i].bytes_per_triangle = static_cast<double>(contenders[i]->bytes()) / static_cast<double>(result.triangles);
    result.builds.insert(result.builds.end(), times.begin(), times.end());
  }
}

WayAgreement check(const TriangleMesh& mesh, const Way& way, std::span<const Ray> rays, const Answers& expected, const Answers& answers) {
  WayAgreement agreement{way, rays.size(), 0, 0, false};
  const bool is_exact = way.contender.is_exact;
  if (query_of(way.kind) != Query::closest) {
    for (std::size_t i = 0; i < rays.size(); ++i)
      if (expected.occluded[i] != answers.occluded[i]) ++agreement.differing;
  } else if (is_exact) {
    for (std::size_t i = 0; i < rays.size(); ++i)
      if (!same_bits(expected.hits[i], answers.hits[i])) ++agreement.differing;
  } else {
    const Agreement judged = compare_hits(mesh, rays, expected.hits, answers.hits);
    agreement.differing = judged.rays - judged.agreeing;
    agreement.unexplained = judged.unexplained;
  }
  const double allowed = is_exact ? 0.0 : kMostDiffering * static_cast<double>(rays.size());
  agreement.is_good = static_cast<double>(agreement.differing) <= allowed;
  return agreement;
}

struct Racer {
  const Entrant* contender;
  Way way;
};

void measure_kind(const TriangleMesh& mesh, const Entrants& contenders, RayKind kind, std::span<const Ray> rays,
                  const MeasureSettings& settings, SceneResult& result) {
  Answers expected(rays.size());
  trace_range(*contenders.front(), {contenders.front()->traits(), 1, kind}, rays, expected, 0, rays.size());
  Answers answers(rays.size());
  std::vector<Racer> racers;
  for (const auto& contender : contenders) {
    for (const std::size_t call_size : contender->call_sizes()) {
      const Way way{contender->traits(), call_size, kind};
      trace_range(*contender, way, rays, answers, 0, rays.size());
      result.agreements.push_back(check(mesh, way, rays, expected, answers));
      if (result.agreements.back().is_good) racers.push_back({contender.get(), way});
    }
  }
  std::vector<int> counts = {1};
  if (settings.threads > 1) counts.push_back(settings.threads);
  for (const int threads : counts) {
    std::vector<WayRate> rates;
    rates.reserve(racers.size());
    for (const Racer& racer : racers) rates.push_back({racer.way, threads, {}});
    for (int round = 0; round < settings.rounds; ++round) {
      for (std::size_t i = 0; i < racers.size(); ++i) {
        double seconds = 0.0;
        if (threads == 1) {
          const Pinned pinned;
          seconds = trace_seconds(*racers[i].contender, racers[i].way, rays, answers, threads);
        } else {
          seconds = trace_seconds(*racers[i].contender, racers[i].way, rays, answers, threads);
        }
        rates[i].mrays_per_s.push_back(1e-6 * static_cast<double>(rays.size()) / seconds);
      }
    }
    result.rates.insert(result.rates.end(), rates.begin(), rates.end());
  }
}

}  // namespace

SceneResult measure_scene(const std::string& source, const MeasureSettings& settings) {
  const Scene loaded = load_scene(source);
  const auto mesh = world_mesh(loaded);
  const Scene scene = scene_of(loaded, mesh);
  SceneResult result;
  result.scene = source;
  result.triangles = mesh->size();
  const Entrants contenders = make_contenders(mesh, settings.structures);
  measure_builds(contenders, settings, result);
  const SceneAccelerator accelerator(scene, "bvh");
  const Camera camera = workload_camera(scene, "");
  for (const RayKind kind : settings.kinds) {
    const std::vector<Ray> rays = make_rays(kind, scene, accelerator, camera, {settings.rays, 2, settings.samples_per_pixel});
    measure_kind(*mesh, contenders, kind, rays, settings, result);
  }
  return result;
}

}  // namespace grove::bench::rivals
