#include "grove/render/render.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <memory>
#include <mutex>
#include <stop_token>
#include <utility>
#include <vector>

#include "grove/base/error.h"
#include "grove/base/parallel.h"
#include "grove/base/timer.h"
#include "grove/render/adaptive/round_planner.h"
#include "grove/render/adaptive/sample_rounds.h"
#include "grove/render/camera_rays.h"
#include "grove/render/film_ray.h"
#include "grove/render/integrator/path.h"
#include "grove/render/integrator/simple.h"
#include "grove/render/sample_batch.h"
#include "grove/render/time_limit.h"
#include "grove/render/view.h"

namespace grove {
namespace {

constexpr std::array<std::string_view, 5> kIntegratorNames = {"path", "ao", "normal", "depth", "cost"};

PicturePart choose_part(const RenderSettings& settings, const TileGrid& grid) {
  if (settings.samples_per_pixel == 0) throw UsageError("a picture needs at least 1 sample per pixel");
  PicturePart part = settings.part;
  if (part.end_sample == 0) part.end_sample = settings.samples_per_pixel;
  if (part.first_sample >= part.end_sample || part.end_sample > settings.samples_per_pixel) {
    throw UsageError("samples " + std::to_string(part.first_sample) + ":" + std::to_string(part.end_sample) + " are not a part of the " +
                     std::to_string(settings.samples_per_pixel) + " of each pixel");
  }
  if (part.share >= part.share_count || part.share >= grid.count()) {
    throw UsageError("tile share " + std::to_string(std::uint64_t{part.share} + 1) + "/" + std::to_string(part.share_count) +
                     " has no tiles: the picture has " + std::to_string(grid.count()));
  }
  if (settings.noise.is_on() && part.samples_per_pixel() != settings.samples_per_pixel) {
    throw UsageError("with a noise target no samples can be left out: which are needed is known only when those before them are there");
  }
  if (!(settings.noise.floor > 0.0F) || settings.noise.min_samples < 2) {
    throw UsageError("a noise target needs at least 2 samples per pixel and a floor above 0");
  }
  return part;
}

// Samples that the film holds of the part.
std::uint64_t count_taken(const Film& film, const PicturePart& part, const TileGrid& grid) {
  std::uint64_t all = 0;
  for (std::size_t i = 0; i < part.tile_count(grid); ++i) {
    const Tile tile = grid.tile(part.tile_number(i));
    for (std::uint32_t y = tile.first_y; y < tile.end_y; ++y) {
      for (std::uint32_t x = tile.first_x; x < tile.end_x; ++x) {
        const std::uint64_t taken = film.pixel(x, y).taken();
        if (taken > part.samples_per_pixel()) {
          throw UsageError("the earlier film has pixels of " + std::to_string(part.first_sample + taken) + " samples, more than the " +
                           std::to_string(part.end_sample) + " that are asked for");
        }
        all += taken;
      }
    }
  }
  return all;
}

// When workers put down what they do: for good, or until what there is has been saved.
class Pause {
 public:
  Pause(std::stop_token stop, double seconds, const TimeLimit& limit) : stop_(std::move(stop)), seconds_(seconds), limit_(limit) {}

  /// While a round must be finished whatever the time.
  void ignore_time_limit(bool ignores) { ignores_limit_ = ignores; }
  [[nodiscard]] bool is_out_of_time() const { return !ignores_limit_ && limit_.is_over(); }
  [[nodiscard]] bool is_stopped() const { return stop_.stop_requested(); }
  /// What is under way is not waited for and not gone on with.
  [[nodiscard]] bool is_final() const { return is_stopped() || is_out_of_time(); }
  /// Not before something was done since the last one, however short the interval.
  [[nodiscard]] bool is_due() const { return has_work_.load(std::memory_order_relaxed) && timer_.seconds() >= seconds_; }
  [[nodiscard]] bool is_wanted() const { return is_final() || is_due(); }
  void note_work() {
    if (!has_work_.load(std::memory_order_relaxed)) has_work_.store(true, std::memory_order_relaxed);
  }
  void restart() {
    timer_ = Timer();
    has_work_ = false;
  }

 private:
  std::stop_token stop_;
  double seconds_;
  const TimeLimit& limit_;
  bool ignores_limit_ = false;
  Timer timer_;
  std::atomic<bool> has_work_{false};
};

// The work that all threads share.
class RenderJob {
 public:
  RenderJob(const PreparedScene& world, const CameraRays& camera, const RenderSettings& settings, std::uint32_t first_sample, Film& film)
      : world_(world), camera_(camera), settings_(settings), film_(film), first_sample_(first_sample) {
    ao_distance_ = settings.ao_distance;
    if (!(ao_distance_ > 0.0F)) ao_distance_ = 0.1F * glm::length(world.scene.bounds().extent());
    if (!(ao_distance_ > 0.0F)) ao_distance_ = std::numeric_limits<float>::infinity();
  }

  /// Takes each pixel to its goal, counted from the part's first sample, or as far as it comes before the pause. Returns how many it took.
  std::uint64_t render_tile(const Tile& tile, const SampleRounds& rounds, Pause& pause) {
    std::uint64_t rays = 0;
    std::uint64_t taken = 0;
    const Timer timer;
    std::unique_ptr<SampleBatch> batch = takes_batches() ? idle_batch() : nullptr;
    const std::uint64_t earlier_rays = batch ? batch->rays_traced() : 0;
    const double earlier_trace = batch ? batch->trace_seconds() : 0.0;
    for (std::uint32_t y = tile.first_y; y < tile.end_y; ++y) {
      for (std::uint32_t x = tile.first_x; x < tile.end_x; ++x) {
        const auto first = static_cast<std::uint32_t>(film_.pixel(x, y).taken());
        const std::uint32_t end = rounds.goal(x, y);
        if (first >= end) continue;
        // Not only between tiles: one may take too long to wait for.
        if (settings_.noise.is_on() ? pause.is_final() : pause.is_wanted()) break;
        for (std::uint32_t s = first; s < end; ++s) {
          if (batch) {
            batch->add(x, y, first_sample_ + s);
          } else {
            film_.add(x, y, sample(x, y, first_sample_ + s, rays));
          }
        }
        taken += end - first;
        pause.note_work();
      }
    }
    if (batch) {
      batch->finish();
      rays += batch->rays_traced() - earlier_rays;
      note_times(timer.seconds(), batch->trace_seconds() - earlier_trace);
      put_back(std::move(batch));
    }
    rays_traced_ += rays;
    return taken;
  }

  /// The same, but all of it or nothing: decisions about noise are made on tiles that stand between rounds.
  std::uint64_t render_whole_tile(const Tile& tile, const SampleRounds& rounds, Pause& pause) {
    std::vector<Film::Pixel> earlier;
    earlier.reserve(tile.pixel_count());
    std::uint64_t wanted = 0;
    for (std::uint32_t y = tile.first_y; y < tile.end_y; ++y) {
      for (std::uint32_t x = tile.first_x; x < tile.end_x; ++x) {
        const Film::Pixel& pixel = earlier.emplace_back(film_.pixel(x, y));
        wanted += std::max<std::uint64_t>(rounds.goal(x, y), pixel.taken()) - pixel.taken();
      }
    }
    if (wanted == 0) return 0;
    if (render_tile(tile, rounds, pause) == wanted) return wanted;
    auto pixel = earlier.cbegin();
    for (std::uint32_t y = tile.first_y; y < tile.end_y; ++y)
      for (std::uint32_t x = tile.first_x; x < tile.end_x; ++x, ++pixel) film_.restore(x, y, *pixel);
    return 0;
  }

  [[nodiscard]] std::uint64_t rays_traced() const { return rays_traced_; }
  /// Sums over threads, of what batches took. Not while tiles are rendered.
  [[nodiscard]] double trace_seconds() const { return trace_seconds_; }
  [[nodiscard]] double shade_seconds() const { return shade_seconds_; }

 private:
  void note_times(double all, double trace) {
    const std::lock_guard lock(batches_);
    trace_seconds_ += trace;
    shade_seconds_ += all - trace;
  }

  [[nodiscard]] PathSettings path_settings() const { return {settings_.max_depth, settings_.indirect_clamp}; }

  [[nodiscard]] bool takes_batches() const { return settings_.ray_calls == RayCalls::batches && settings_.integrator == Integrator::path; }

  // One that no other thread uses, until it is put back.
  std::unique_ptr<SampleBatch> idle_batch() {
    {
      const std::lock_guard lock(batches_);
      if (!idle_batches_.empty()) {
        std::unique_ptr<SampleBatch> batch = std::move(idle_batches_.back());
        idle_batches_.pop_back();
        return batch;
      }
    }
    return std::make_unique<SampleBatch>(world_, camera_, path_settings(), settings_.seed, film_);
  }

  void put_back(std::unique_ptr<SampleBatch> batch) {
    const std::lock_guard lock(batches_);
    idle_batches_.push_back(std::move(batch));
  }

  Film::Sample sample(std::uint32_t x, std::uint32_t y, std::uint32_t number, std::uint64_t& rays) const {
    const Sampler sampler(settings_.seed, x, y, number);
    const Ray ray = film_ray(camera_, x, y, sampler);
    RayTracer tracer(world_, sampler);
    Film::Sample result;
    switch (settings_.integrator) {
      case Integrator::path:
        result = trace_path(world_, path_settings(), ray, sampler, tracer);
        break;
      case Integrator::ao:
        result = trace_ambient_occlusion(world_, ao_distance_, ray, sampler, tracer);
        break;
      case Integrator::normal:
        result = trace_normal(world_, ray, sampler, tracer);
        break;
      case Integrator::depth:
        result = trace_depth(world_, ray, sampler, tracer);
        break;
      case Integrator::cost:
        result = trace_cost(world_, ray);
        ++rays;
        break;
    }
    rays += tracer.rays_traced();
    return result;
  }

  const PreparedScene& world_;
  const CameraRays& camera_;
  const RenderSettings& settings_;
  Film& film_;
  std::uint32_t first_sample_;
  float ao_distance_ = 0.0F;
  std::atomic<std::uint64_t> rays_traced_{0};
  std::mutex batches_;
  std::vector<std::unique_ptr<SampleBatch>> idle_batches_;
  double trace_seconds_ = 0.0;
  double shade_seconds_ = 0.0;
};

// `prepare` is called when nothing else can be found wrong.
RenderResult render_prepared(const Scene& scene, const std::function<const PreparedScene&()>& prepare, const RenderSettings& settings,
                             const ProgressReporter& progress, RenderCheckpoints checkpoints) {
  const Timer timer;
  const TimeLimit limit(settings.time_limit, settings.clock);
  const View view = choose_view(scene, settings);
  const TileGrid grid(view.width, view.height);
  RenderResult result;
  if (checkpoints.earlier) {
    result = std::move(*checkpoints.earlier);
  } else {
    result.film = Film(view.width, view.height);
  }
  result.integrator = settings.integrator;
  result.camera = view.camera.name;
  result.part = choose_part(settings, grid);
  result.warnings.clear();
  if (result.film.width() != view.width || result.film.height() != view.height) throw UsageError("the earlier film is of another size");

  const CameraRays camera_rays(view.camera, view.width, view.height);
  const PreparedScene& world = prepare();
  if (settings.integrator == Integrator::path && world.lights.has_default_sky()) {
    result.warnings.emplace_back("the scene has no light; lit by a default sky");
  }

  result.prepare_seconds += timer.seconds();
  RenderJob job(world, camera_rays, settings, result.part.first_sample, result.film);
  const std::uint64_t earlier_samples = count_taken(result.film, result.part, grid);
  const std::uint64_t earlier_rays = result.rays_traced;
  const double earlier_seconds = result.seconds;
  const double earlier_trace = result.trace_seconds;
  const double earlier_shade = result.shade_seconds;
  SampleRounds rounds(result.film, result.part, settings.noise);
  RoundPlanner planner(rounds, limit);
  std::uint64_t done = earlier_samples;
  std::uint64_t total = done;
  const auto take_stock = [&] {
    result.rays_traced = earlier_rays + job.rays_traced();
    result.trace_seconds = earlier_trace + job.trace_seconds();
    result.shade_seconds = earlier_shade + job.shade_seconds();
    result.dropped_samples = result.film.dropped_samples();
    result.completed_fraction = done < total ? static_cast<double>(done) / static_cast<double>(total) : 1.0;
    result.out_of_time = planner.is_out_of_time();
    result.interrupted = done < total && !result.out_of_time;
    result.seconds = earlier_seconds + timer.seconds();
  };

  Pause pause(progress.stop, checkpoints.save ? checkpoints.interval_seconds : std::numeric_limits<double>::infinity(), limit);
  std::mutex reporting;
  Film film_before;  // of this round, where it may have to be taken back
  std::uint64_t done_before = done;
  bool is_under_way = false;
  for (;;) {
    if (!is_under_way) {
      if (!planner.plan_next()) break;
      total = done + rounds.samples_left();
      done_before = done;
      pause.ignore_time_limit(planner.is_first_round());
      if (limit.is_on() && !planner.is_first_round()) film_before = result.film;
      is_under_way = true;
    }
    if (pause.is_stopped()) break;
    if (pause.is_due()) {
      take_stock();
      checkpoints.save(result);
      pause.restart();
    }
    parallel_for(result.part.tile_count(grid), 1, [&](std::size_t i) {
      if (pause.is_wanted()) return;
      const Tile tile = grid.tile(result.part.tile_number(i));
      const std::uint64_t taken =
          settings.noise.is_on() ? job.render_whole_tile(tile, rounds, pause) : job.render_tile(tile, rounds, pause);
      const std::lock_guard lock(reporting);
      done += taken;
      if (progress.report) progress.report(done - earlier_samples, planner.foreseen(done - earlier_samples, total - earlier_samples));
    });
    // What is left of the round after a pause is taken up again; what did not fit into the time is taken back.
    if (done - done_before == rounds.samples()) {
      planner.note_round(rounds.samples());
      is_under_way = false;
    } else if (pause.is_out_of_time()) {
      result.film = std::move(film_before);
      done = done_before;
      planner.stop_in_time();
      break;
    }
  }
  if (rounds.samples() == 0) total = done;

  const Timer gathering;
  if (settings.gathering.first_hits) {
    result.first_hits =
        gather_first_hits(world, camera_rays, result.film, {settings.seed, result.part.first_sample}, settings.gathering.earlier);
    result.gather_seconds += gathering.seconds();
  }
  take_stock();
  if (result.dropped_samples > 0) {
    result.warnings.push_back(std::to_string(result.dropped_samples) + " samples were not a number, infinite or negative, and left out");
  }
  return result;
}

}  // namespace

std::span<const std::string_view> integrator_names() {
  return kIntegratorNames;
}

Integrator integrator_from_name(std::string_view name) {
  std::string list;
  for (std::size_t i = 0; i < kIntegratorNames.size(); ++i) {
    if (name == kIntegratorNames[i]) return static_cast<Integrator>(i);
    list += (i == 0 ? "" : ", ") + std::string(kIntegratorNames[i]);
  }
  throw UsageError("unknown integrator '" + std::string(name) + "'; choose one of " + list);
}

RenderResult render(const Scene& scene, const SceneAccelerator& accelerator, const RenderSettings& settings,
                    const ProgressReporter& progress, RenderCheckpoints checkpoints) {
  std::optional<PreparedScene> world;
  const auto prepare = [&]() -> const PreparedScene& { return world.emplace(scene, accelerator, settings.lights); };
  return render_prepared(scene, prepare, settings, progress, std::move(checkpoints));
}

RenderResult render(const PreparedScene& world, const RenderSettings& settings, const ProgressReporter& progress,
                    RenderCheckpoints checkpoints) {
  const auto prepared = [&]() -> const PreparedScene& { return world; };
  return render_prepared(world.scene, prepared, settings, progress, std::move(checkpoints));
}

}  // namespace grove
