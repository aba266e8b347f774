#include "grove/render/render.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>
#include <stop_token>

#include "grove/base/error.h"
#include "grove/base/parallel.h"
#include "grove/base/timer.h"
#include "grove/render/camera_rays.h"
#include "grove/render/film_ray.h"
#include "grove/render/integrator/path.h"
#include "grove/render/integrator/simple.h"

namespace grove {
namespace {

constexpr std::array<std::string_view, 5> kIntegratorNames = {"path", "ao", "normal", "depth", "cost"};
constexpr std::uint32_t kTileSide = 16;
constexpr std::uint32_t kMaxSide = 1U << 16;
constexpr std::uint64_t kMaxPixels = 1ULL << 28;

struct FilmSize {
  std::uint32_t width;
  std::uint32_t height;
};

FilmSize film_size(const Scene& scene, const RenderSettings& settings) {
  FilmSize natural{scene.film.width, scene.film.height};
  if (natural.width == 0 || natural.height == 0) natural = {1280, 720};
  FilmSize size{settings.width, settings.height};
  const double aspect = static_cast<double>(natural.width) / natural.height;
  if (size.width == 0 && size.height == 0) {
    size = natural;
  } else if (size.width == 0) {
    size.width = static_cast<std::uint32_t>(std::clamp(std::round(size.height * aspect), 1.0, double{kMaxSide} + 1.0));
  } else if (size.height == 0) {
    size.height = static_cast<std::uint32_t>(std::clamp(std::round(size.width / aspect), 1.0, double{kMaxSide} + 1.0));
  }
  if (size.width > kMaxSide || size.height > kMaxSide || std::uint64_t{size.width} * size.height > kMaxPixels) {
    throw UsageError("a picture of " + std::to_string(size.width) + " x " + std::to_string(size.height) +
                     " pixels is too large; the limit is 65536 a side and 2^28 in all");
  }
  return size;
}

std::string list_cameras(const Scene& scene) {
  std::string names;
  for (const Camera& camera : scene.cameras) names += (names.empty() ? "'" : ", '") + camera.name + "'";
  return names.empty() ? "the scene has none; leave the name out for a view of all of it" : "there are " + names;
}

Camera choose_camera(const Scene& scene, const RenderSettings& settings, const FilmSize& size) {
  if (!settings.camera.empty()) {
    for (const Camera& camera : scene.cameras)
      if (camera.name == settings.camera) return camera;
    throw UsageError("no camera is named '" + settings.camera + "': " + list_cameras(scene));
  }
  if (!scene.cameras.empty()) return scene.cameras.front();
  return frame_bounds(scene.bounds(), static_cast<float>(size.width) / static_cast<float>(size.height));
}

// The work that all threads share.
class RenderJob {
 public:
  RenderJob(const PreparedScene& world, const CameraRays& camera, const RenderSettings& settings, Film& film)
      : world_(world), camera_(camera), settings_(settings), film_(film) {
    ao_distance_ = settings.ao_distance;
    if (!(ao_distance_ > 0.0F)) ao_distance_ = 0.1F * glm::length(world.scene.bounds().extent());
    if (!(ao_distance_ > 0.0F)) ao_distance_ = std::numeric_limits<float>::infinity();
  }

  /// Returns how many pixels it finished: all, unless it was stopped.
  std::uint64_t render_tile(std::uint32_t tile_x, std::uint32_t tile_y, const std::stop_token& stop) {
    const std::uint32_t last_x = std::min(film_.width(), (tile_x + 1) * kTileSide);
    const std::uint32_t last_y = std::min(film_.height(), (tile_y + 1) * kTileSide);
    std::uint64_t rays = 0;
    std::uint64_t dropped = 0;
    std::uint64_t finished = 0;
    for (std::uint32_t y = tile_y * kTileSide; y < last_y; ++y) {
      for (std::uint32_t x = tile_x * kTileSide; x < last_x; ++x) {
        // With many samples a pixel, a tile takes too long to wait for.
        if (stop.stop_requested()) break;
        for (std::uint32_t s = 0; s < settings_.samples_per_pixel; ++s) {
          if (!film_.add(x, y, sample(x, y, s, rays))) ++dropped;
        }
        ++finished;
      }
    }
    rays_traced_ += rays;
    dropped_samples_ += dropped;
    return finished;
  }

  [[nodiscard]] std::uint64_t rays_traced() const { return rays_traced_; }
  [[nodiscard]] std::uint64_t dropped_samples() const { return dropped_samples_; }

 private:
  Film::Sample sample(std::uint32_t x, std::uint32_t y, std::uint32_t number, std::uint64_t& rays) const {
    const Sampler sampler(settings_.seed, x, y, number);
    const Ray ray = film_ray(camera_, x, y, sampler);
    RayTracer tracer(world_, sampler);
    Film::Sample result;
    switch (settings_.integrator) {
      case Integrator::path:
        result = trace_path(world_, {settings_.max_depth, settings_.indirect_clamp}, ray, sampler, tracer);
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
  float ao_distance_ = 0.0F;
  std::atomic<std::uint64_t> rays_traced_{0};
  std::atomic<std::uint64_t> dropped_samples_{0};
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
                    const ProgressReporter& progress) {
  const Timer timer;
  if (settings.samples_per_pixel == 0) throw UsageError("a picture needs at least 1 sample per pixel");
  const FilmSize size = film_size(scene, settings);
  const Camera camera = choose_camera(scene, settings, size);
  const CameraRays camera_rays(camera, size.width, size.height);
  const PreparedScene world(scene, accelerator);

  RenderResult result;
  result.integrator = settings.integrator;
  result.camera = camera.name;
  result.film = Film(size.width, size.height);
  if (settings.integrator == Integrator::path && world.lights.has_default_sky()) {
    result.warnings.emplace_back("the scene has no light; lit by a default sky");
  }

  RenderJob job(world, camera_rays, settings, result.film);
  const std::uint32_t tiles_x = (size.width + kTileSide - 1) / kTileSide;
  const std::uint32_t tiles_y = (size.height + kTileSide - 1) / kTileSide;
  const std::uint64_t total = std::uint64_t{size.width} * size.height;
  std::mutex reporting;
  std::uint64_t done = 0;
  parallel_for(std::size_t{tiles_x} * tiles_y, 1, [&](std::size_t tile) {
    if (progress.stop.stop_requested()) return;
    const auto tile_x = static_cast<std::uint32_t>(tile % tiles_x);
    const auto tile_y = static_cast<std::uint32_t>(tile / tiles_x);
    const std::uint64_t pixels = job.render_tile(tile_x, tile_y, progress.stop);
    const std::lock_guard lock(reporting);
    done += pixels;
    if (progress.report) progress.report(done, total);
  });

  result.rays_traced = job.rays_traced();
  result.dropped_samples = job.dropped_samples();
  if (result.dropped_samples > 0) {
    result.warnings.push_back(std::to_string(result.dropped_samples) + " samples were not a number, infinite or negative, and left out");
  }
  result.completed_fraction = static_cast<double>(done) / static_cast<double>(total);
  result.interrupted = done < total;
  result.seconds = timer.seconds();
  return result;
}

}  // namespace grove
