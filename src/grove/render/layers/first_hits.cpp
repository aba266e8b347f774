#include "grove/render/layers/first_hits.h"

#include <algorithm>
#include <vector>

#include "grove/base/parallel.h"
#include "grove/render/film_ray.h"
#include "grove/render/integrator/ray_batch.h"

namespace grove {
namespace {

// More change the means of depth and motion less than anybody looks at.
constexpr std::uint32_t kMostSamples = 32;
// Rays that are traced together, at least where a row has as many.
constexpr std::size_t kBatch = 1024;

// What the samples of a pixel have met so far.
struct Sums {
  FirstHit first;
  FilmPlace place;
  float earlier_depth = 0.0F;
  Vec3 emitted{0.0F};
  std::uint32_t met = 0;
  std::uint32_t traced = 0;
};

class Gathering {
 public:
  Gathering(const PreparedScene& world, const CameraRays& camera, const EarlierFrame* earlier)
      : world_(world), camera_(camera), earlier_(earlier) {}

  // The next sample of a pixel.
  void take(const Ray& ray, const Hit& hit, Sums& sums) const {
    const bool is_first = sums.traced++ == 0;
    if (!hit) {
      const EnvironmentLight& sky = world_.lights.environment();
      if (sky.is_on()) sums.emitted += sky.radiance(ray.direction);
      // What is infinitely far moves with the camera alone.
      if (is_first && earlier_ != nullptr) sums.first.motion = motion(Vec4(ray.direction, 0.0F), Vec4(ray.direction, 0.0F)).film;
      return;
    }
    if (is_first) {
      sums.first.primitive = hit.primitive;
      sums.first.geometry = hit.geometry;
      sums.first.instance = hit.instance;
    }
    const SurfacePoint point = world_.surfaces.at(ray, hit);
    sums.emitted += world_.lights.emitted(point, -ray.direction);
    const Vec3& now = point.position;
    const float depth = camera_.place(Vec4(now, 1.0F)).depth;
    sums.place.depth += depth;
    if (earlier_ != nullptr) {
      const Vec3 then = earlier_->pose.position_then(world_.scene, hit, now);
      const FilmPlace moved = motion(Vec4(then, 1.0F), Vec4(now, 1.0F));
      sums.place.film += moved.film;
      sums.earlier_depth += moved.depth;
    } else {
      sums.earlier_depth += depth;
    }
    ++sums.met;
  }

  [[nodiscard]] static FirstHit mean(const Sums& sums) {
    FirstHit result = sums.first;
    result.emitted = sums.emitted / static_cast<float>(sums.traced);
    if (sums.met > 0) {
      const auto divisor = static_cast<float>(sums.met);
      result.depth = sums.place.depth / divisor;
      result.earlier_depth = sums.earlier_depth / divisor;
      result.motion = sums.place.film / divisor;
    }
    return result;
  }

 private:
  // The motion in the picture, and the depth before. What was behind the camera has none.
  [[nodiscard]] FilmPlace motion(const Vec4& then, const Vec4& now) const {
    const FilmPlace place_then = earlier_->camera.place(then);
    if (!(place_then.depth > 0.0F)) return {Vec2(0.0F), place_then.depth};
    return {camera_.place(now).film - place_then.film, place_then.depth};
  }

  const PreparedScene& world_;
  const CameraRays& camera_;
  const EarlierFrame* earlier_;
};

// A row of the picture, whose samples are traced in batches.
class Row {
 public:
  Row(const PreparedScene& world, const CameraRays& camera, const Film& film, const SampleRange& samples, const Gathering& gathering,
      std::uint32_t y)
      : camera_(camera), film_(film), samples_(samples), gathering_(gathering), y_(y), tracer_(world), sums_(film.width()) {}

  void gather(FirstHits& hits) {
    for (std::uint32_t x = 0; x < film_.width(); ++x) ask(x, 0, std::min(taken(x), kMostSamples));
    trace();
    // What is emitted is wanted of all samples.
    for (std::uint32_t x = 0; x < film_.width(); ++x)
      if (sums_[x].emitted != Vec3(0.0F)) ask(x, std::min(taken(x), kMostSamples), taken(x));
    trace();
    for (std::uint32_t x = 0; x < film_.width(); ++x)
      if (sums_[x].traced > 0) hits.at(x, y_) = Gathering::mean(sums_[x]);
  }

 private:
  [[nodiscard]] std::uint32_t taken(std::uint32_t x) const { return static_cast<std::uint32_t>(film_.pixel(x, y_).taken()); }

  // Asks for samples [first, last) of a pixel.
  void ask(std::uint32_t x, std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t s = first; s < last; ++s) {
      const Sampler sampler(samples_.seed, x, y_, samples_.first + s);
      rays_.push_back(film_ray(camera_, x, y_, sampler));
      paths_.emplace_back(sampler, x);
      if (rays_.size() == kBatch) trace();
    }
  }

  void trace() {
    hits_.resize(rays_.size());
    tracer_.find_surfaces(rays_, hits_, paths_, 0);
    for (std::size_t i = 0; i < rays_.size(); ++i) gathering_.take(rays_[i], hits_[i], sums_[paths_[i].id]);
    rays_.clear();
    paths_.clear();
  }

  const CameraRays& camera_;
  const Film& film_;
  const SampleRange& samples_;
  const Gathering& gathering_;
  std::uint32_t y_;
  RayBatch tracer_;
  std::vector<Sums> sums_;
  std::vector<Ray> rays_;
  std::vector<PathState> paths_;
  std::vector<Hit> hits_;
};

}  // namespace

FirstHits gather_first_hits(const PreparedScene& world, const CameraRays& camera, const Film& film, const SampleRange& samples,
                            const EarlierFrame* earlier) {
  FirstHits hits(film.width(), film.height());
  const Gathering gathering(world, camera, earlier);
  parallel_for(film.height(), 4,
               [&](std::size_t row) { Row(world, camera, film, samples, gathering, static_cast<std::uint32_t>(row)).gather(hits); });
  return hits;
}

}  // namespace grove
