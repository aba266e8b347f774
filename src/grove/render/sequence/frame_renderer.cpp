#include "grove/render/sequence/frame_renderer.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "grove/base/error.h"
#include "grove/base/timer.h"

namespace grove {
namespace {

void keep_new(const std::vector<std::string>& lines, std::vector<std::string>& all) {
  for (const std::string& line : lines) {
    if (std::ranges::find(all, line) == all.end()) all.push_back(line);
  }
}

}  // namespace

FrameRenderer::FrameRenderer(AnimatedScene& scene, std::string_view spec, UpdatePolicy policy)
    : scene_(scene), spec_(canonical_spec(spec)), policy_(policy) {}

SceneChanges FrameRenderer::follow(double time, RenderedFrame& frame) {
  const Timer posing;
  SceneChanges changes = scene_.move_to(time);
  frame.pose_seconds += posing.seconds();
  if (accelerator_ == nullptr) {
    const Timer building;
    const bool has_moving_instances = scene_.animation() && !scene_.animation()->instances.empty();
    accelerator_ =
        std::make_unique<SceneAccelerator>(scene_.scene(), spec_, has_moving_instances ? TopLevel::always : TopLevel::where_needed);
    frame.is_built = true;
    frame.build_seconds = building.seconds();
    return changes;
  }
  frame.moved_instances += static_cast<std::uint32_t>(changes.instances.size());
  frame.moved_objects += static_cast<std::uint32_t>(changes.objects.size());
  const double seconds = frame.update.seconds;
  frame.update = accelerator_->update(scene_.scene(), changes, policy_, rays_);
  frame.update.seconds += seconds;
  return changes;
}

double FrameRenderer::prepare(const SceneChanges& changes, LightSampling sampling) {
  const Timer timer;
  if (world_ != nullptr && world_->lights.sampling() == sampling) {
    world_->follow(changes);
  } else {
    world_ = std::make_unique<PreparedScene>(scene_.scene(), *accelerator_, sampling);
  }
  return timer.seconds();
}

RenderedFrame FrameRenderer::render(RenderSettings settings, const Exposure& exposure, const ProgressReporter& progress,
                                    const std::function<Camera(double time)>& viewpoint) {
  const std::uint64_t samples = settings.samples_per_pixel;
  const std::uint32_t times = exposure.duration > 0.0 ? exposure.times : 1;
  if (times < 1 || times > samples) {
    throw UsageError("the shutter can be open at 1 to " + std::to_string(samples) +
                     " times, as many as there are samples per pixel, not at " + std::to_string(times));
  }
  if (times > 1 && (settings.part.first_sample != 0 || settings.part.end_sample != 0)) {
    throw UsageError("a range of samples cannot be rendered with motion blur, which spreads them over time");
  }
  if (times > 1 && (settings.noise.target > 0.0F || settings.time_limit > 0.0)) {
    throw UsageError("motion blur needs the same number of samples at each time: leave out the noise target and the time limit");
  }
  RenderedFrame frame;
  std::vector<std::string> warnings;
  for (std::uint32_t k = 0; k < times; ++k) {
    const double time = exposure.time + exposure.duration * (k + 0.5) / times;
    const SceneChanges changes = follow(time, frame);
    const double prepare_seconds = prepare(changes, settings.lights);
    if (viewpoint) settings.viewpoint = viewpoint(time);
    RenderCheckpoints so_far;
    if (times > 1) settings.part.end_sample = static_cast<std::uint32_t>(samples * (k + 1) / times);
    if (k > 0) so_far.earlier = std::move(frame.picture);
    const std::uint64_t rays_before = so_far.earlier ? so_far.earlier->rays_traced : 0;
    ProgressReporter part = progress;
    if (progress.report) {
      part.report = [&, k](std::uint64_t done, std::uint64_t total) { progress.report(k * total + done, times * total); };
    }
    frame.picture = grove::render(*world_, settings, part, std::move(so_far));
    frame.picture.prepare_seconds += prepare_seconds;
    frame.picture.seconds += prepare_seconds;
    rays_ = static_cast<double>(frame.picture.rays_traced - rays_before);
    keep_new(frame.picture.warnings, warnings);
    if (frame.picture.interrupted) break;
  }
  if (frame.picture.interrupted) {
    frame.picture.completed_fraction *= static_cast<double>(frame.picture.part.end_sample) / static_cast<double>(samples);
  }
  frame.picture.warnings = std::move(warnings);
  return frame;
}

}  // namespace grove
