#include "grove/render/record_rays.h"

#include "grove/base/parallel.h"
#include "grove/render/film_ray.h"
#include "grove/render/integrator/path.h"

namespace grove {
namespace {

/// Pixels whose rays are recorded by one task.
constexpr std::size_t kChunk = 256;

}  // namespace

std::vector<RecordedRay> record_rays(const Scene& scene, const SceneAccelerator& accelerator, const Camera& camera,
                                     const RecordSettings& settings) {
  const CameraRays camera_rays(camera, settings.width, settings.height);
  const PreparedScene world(scene, accelerator);
  const std::size_t pixels = std::size_t{settings.width} * settings.height;
  std::vector<std::vector<RecordedRay>> chunks((pixels + kChunk - 1) / kChunk);
  parallel_chunks(pixels, kChunk, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    for (std::size_t pixel = first; pixel < last; ++pixel) {
      const auto x = static_cast<std::uint32_t>(pixel % settings.width);
      const auto y = static_cast<std::uint32_t>(pixel / settings.width);
      const Sampler sampler(settings.seed, x, y, 0);
      RayTracer tracer(world, sampler, &chunks[chunk]);
      static_cast<void>(trace_path(world, {settings.max_depth}, film_ray(camera_rays, x, y, sampler), sampler, tracer));
    }
  });
  std::size_t count = 0;
  for (const std::vector<RecordedRay>& chunk : chunks) count += chunk.size();
  std::vector<RecordedRay> rays;
  rays.reserve(count);
  for (const std::vector<RecordedRay>& chunk : chunks) rays.insert(rays.end(), chunk.begin(), chunk.end());
  return rays;
}

}  // namespace grove
