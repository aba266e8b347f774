#include "grove/render/layers/first_hits.h"

#include "grove/base/parallel.h"
#include "grove/render/film_ray.h"
#include "grove/render/integrator/ray_tracer.h"

namespace grove {
namespace {

// More change the means of depth and motion less than anybody looks at.
constexpr std::uint32_t kMostSamples = 32;

class Gathering {
 public:
  Gathering(const PreparedScene& world, const CameraRays& camera, const SampleRange& samples, const EarlierFrame* earlier)
      : world_(world), camera_(camera), samples_(samples), earlier_(earlier) {}

  [[nodiscard]] FirstHit pixel(std::uint32_t x, std::uint32_t y, std::uint32_t count) const {
    FirstHit result;
    FilmPlace mean_place;
    float earlier_depth = 0.0F;
    Vec3 emitted(0.0F);
    std::uint32_t met = 0;
    std::uint32_t traced = 0;
    for (std::uint32_t s = 0; s < count && (s < kMostSamples || emitted != Vec3(0.0F)); ++s) {
      const Sampler sampler(samples_.seed, x, y, samples_.first + s);
      const Ray ray = film_ray(camera_, x, y, sampler);
      RayTracer tracer(world_, sampler);
      SurfaceHit surface;
      ++traced;
      if (!tracer.find_surface(ray, surface)) {
        const EnvironmentLight& sky = world_.lights.environment();
        if (sky.is_on()) emitted += sky.radiance(surface.ray.direction);
        // What is infinitely far moves with the camera alone.
        if (s == 0 && earlier_ != nullptr) result.motion = motion(Vec4(ray.direction, 0.0F), Vec4(ray.direction, 0.0F)).film;
        continue;
      }
      if (s == 0) {
        result.primitive = surface.hit.primitive;
        result.geometry = surface.hit.geometry;
        result.instance = surface.hit.instance;
      }
      emitted += world_.lights.emitted(surface.point, -surface.ray.direction);
      const Vec3& now = surface.point.position;
      const float depth = camera_.place(Vec4(now, 1.0F)).depth;
      mean_place.depth += depth;
      if (earlier_ != nullptr) {
        const Vec3 then = earlier_->pose.position_then(world_.scene, surface.hit, now);
        const FilmPlace moved = motion(Vec4(then, 1.0F), Vec4(now, 1.0F));
        mean_place.film += moved.film;
        earlier_depth += moved.depth;
      } else {
        earlier_depth += depth;
      }
      ++met;
    }
    result.emitted = emitted / static_cast<float>(traced);
    if (met > 0) {
      const auto divisor = static_cast<float>(met);
      result.depth = mean_place.depth / divisor;
      result.earlier_depth = earlier_depth / divisor;
      result.motion = mean_place.film / divisor;
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
  SampleRange samples_;
  const EarlierFrame* earlier_;
};

}  // namespace

FirstHits gather_first_hits(const PreparedScene& world, const CameraRays& camera, const Film& film, const SampleRange& samples,
                            const EarlierFrame* earlier) {
  FirstHits hits(film.width(), film.height());
  const Gathering gathering(world, camera, samples, earlier);
  parallel_for(film.height(), 4, [&](std::size_t row) {
    const auto y = static_cast<std::uint32_t>(row);
    for (std::uint32_t x = 0; x < film.width(); ++x) {
      const auto taken = static_cast<std::uint32_t>(film.pixel(x, y).taken());
      if (taken > 0) hits.at(x, y) = gathering.pixel(x, y, taken);
    }
  });
  return hits;
}

}  // namespace grove
