#include "grove/render/render.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <limits>
#include <memory>
#include <mutex>
#include <stop_token>
#include <utility>
#include <vector>

#include "grove/base/error.h"
#include "grove/base/parallel.h"
#include "grove/base/timer.h"
#include "grove/render/camera_rays.h"
#include "grove/render/film_ray.h"
#include "grove/render/integrator/path.h"
#include "grove/render/integrator/simple.h"
#include "grove/render/sample_batch.h"
#include "grove/render/view.h"

namespace grove {
namespace {

constexpr std::array<std::string_view, 5> kIntegratorNames = {"path", "ao", "normal", "depth", "cost"};

// Each pass takes each pixel to one of 1, 2, 4, 8, 16, 32, 48, … samples: the first numbers are those at which the sample points are spread
// most evenly, and passes of 16 are long enough to cost nothing.
constexpr std::uint32_t kLongestPass = 16;

std::uint32_t end_of_next_pass(std::uint32_t taken) {
  if (taken >= kLongestPass) return taken / kLongestPass * kLongestPass + kLongestPass;
  return std::bit_ceil(taken + 1);
}

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
  return part;
}

// How far a film has come.
struct Progression {
  std::uint64_t taken = 0;  // over all pixels of the part
  std::uint32_t least = 0;  // of any pixel
};

Progression progression(const Film& film, const PicturePart& part, const TileGrid& grid) {
  Progression all;
  std::uint64_t least = part.samples_per_pixel();
  for (std::size_t i = 0; i < part.tile_count(grid); ++i) {
    const Tile tile = grid.tile(part.tile_number(i));
    for (std::uint32_t y = tile.first_y; y < tile.end_y; ++y) {
      for (std::uint32_t x = tile.first_x; x < tile.end_x; ++x) {
        const std::uint64_t taken = film.pixel(x, y).taken();
        if (taken > part.samples_per_pixel()) {
          throw UsageError("the earlier film has pixels of " + std::to_string(part.first_sample + taken) + " samples, more than the " +
                           std::to_string(part.end_sample) + " that are asked for");
        }
        least = std::min(least, taken);
        all.taken += taken;
      }
    }
  }
  all.least = static_cast<std::uint32_t>(least);
  return all;
}

// When workers put down what they do: for good, or until what there is has been saved.
class Pause {
 public:
  Pause(std::stop_token stop, double seconds) : stop_(std::move(stop)), seconds_(seconds) {}

  [[nodiscard]] bool is_stopped() const { return stop_.stop_requested(); }
  /// Not before something was done since the last one, however short the interval.
  [[nodiscard]] bool is_due() const { return has_work_.load(std::memory_order_relaxed) && timer_.seconds() >= seconds_; }
  [[nodiscard]] bool is_wanted() const { return is_stopped() || is_due(); }
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
  Timer timer_;
  std::atomic<bool> has_work_{false};
};

// The work that all threads share.
class RenderJob {
 public:
  RenderJob(const PreparedScene& world, const CameraRays& camera, const RenderSettings& settings, std::uint32_t first_sample, Film& film,
            RadianceMoments* moments)
      : world_(world), camera_(camera), settings_(settings), film_(film), moments_(moments), first_sample_(first_sample) {
    ao_distance_ = settings.ao_distance;
    if (!(ao_distance_ > 0.0F)) ao_distance_ = 0.1F * glm::length(world.scene.bounds().extent());
    if (!(ao_distance_ > 0.0F)) ao_distance_ = std::numeric_limits<float>::infinity();
  }

  /// Takes each pixel to `end` samples, counted from the part's first, or as far as it comes before the pause. Returns how many it took.
  std::uint64_t render_tile(const Tile& tile, std::uint32_t end, Pause& pause) {
    std::uint64_t rays = 0;
    std::uint64_t taken = 0;
    std::unique_ptr<SampleBatch> batch = takes_batches() ? idle_batch() : nullptr;
    const std::uint64_t earlier_rays = batch ? batch->rays_traced() : 0;
    for (std::uint32_t y = tile.first_y; y < tile.end_y; ++y) {
      for (std::uint32_t x = tile.first_x; x < tile.end_x; ++x) {
        const auto first = static_cast<std::uint32_t>(film_.pixel(x, y).taken());
        if (first >= end) continue;
        // Not only between tiles: one may take too long to wait for.
        if (pause.is_wanted()) break;
        for (std::uint32_t s = first; s < end; ++s) {
          if (batch) {
            batch->add(x, y, first_sample_ + s);
          } else {
            add_sample(film_, moments_, x, y, sample(x, y, first_sample_ + s, rays));
          }
        }
        taken += end - first;
        pause.note_work();
      }
    }
    if (batch) {
      batch->finish();
      rays += batch->rays_traced() - earlier_rays;
      put_back(std::move(batch));
    }
    rays_traced_ += rays;
    return taken;
  }

  [[nodiscard]] std::uint64_t rays_traced() const { return rays_traced_; }

 private:
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
    return std::make_unique<SampleBatch>(world_, camera_, path_settings(), settings_.seed, film_, moments_);
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
  RadianceMoments* moments_;  // or null
  std::uint32_t first_sample_;
  float ao_distance_ = 0.0F;
  std::atomic<std::uint64_t> rays_traced_{0};
  std::mutex batches_;
  std::vector<std::unique_ptr<SampleBatch>> idle_batches_;
};

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
  const Timer timer;
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
  const PreparedScene world(scene, accelerator);
  if (settings.integrator == Integrator::path && world.lights.has_default_sky()) {
    result.warnings.emplace_back("the scene has no light; lit by a default sky");
  }

  if (settings.gathering.moments && !result.moments) result.moments.emplace(view.width, view.height);
  RenderJob job(world, camera_rays, settings, result.part.first_sample, result.film, result.moments ? &*result.moments : nullptr);
  const Progression earlier = progression(result.film, result.part, grid);
  const std::uint32_t samples = result.part.samples_per_pixel();
  const std::uint64_t total = result.part.pixel_count(grid) * samples;
  const std::uint64_t earlier_rays = result.rays_traced;
  const double earlier_seconds = result.seconds;
  std::uint64_t done = earlier.taken;
  const auto take_stock = [&] {
    result.rays_traced = earlier_rays + job.rays_traced();
    result.dropped_samples = result.film.dropped_samples();
    result.completed_fraction = static_cast<double>(done) / static_cast<double>(total);
    result.interrupted = done < total;
    result.seconds = earlier_seconds + timer.seconds();
  };

  Pause pause(progress.stop, checkpoints.save ? checkpoints.interval_seconds : std::numeric_limits<double>::infinity());
  std::mutex reporting;
  std::uint32_t end = std::min(samples, end_of_next_pass(earlier.least));
  while (done < total && !pause.is_stopped()) {
    if (pause.is_due()) {
      take_stock();
      checkpoints.save(result);
      pause.restart();
    }
    parallel_for(result.part.tile_count(grid), 1, [&](std::size_t i) {
      if (pause.is_wanted()) return;
      const std::uint64_t taken = job.render_tile(grid.tile(result.part.tile_number(i)), end, pause);
      const std::lock_guard lock(reporting);
      done += taken;
      if (progress.report) progress.report(done - earlier.taken, total - earlier.taken);
    });
    // What was left of the pass at a pause is taken up again.
    if (!pause.is_wanted()) end = std::min(samples, end_of_next_pass(end));
  }

  if (settings.gathering.first_hits) {
    result.first_hits =
        gather_first_hits(world, camera_rays, result.film, {settings.seed, result.part.first_sample}, settings.gathering.earlier);
  }
  take_stock();
  if (result.dropped_samples > 0) {
    result.warnings.push_back(std::to_string(result.dropped_samples) + " samples were not a number, infinite or negative, and left out");
  }
  return result;
}

}  // namespace grove
