#include "grove/lab/view/structure_sample.h"

#include <algorithm>

namespace grove {
namespace {

std::uint64_t steps_of(const TraversalCounts& counts) {
  return counts.nodes_visited + counts.primitives_tested;
}

/// The distance of rays, a power of two, at which the picture takes at most about `most_steps` steps: judged by a coarse one.
std::uint32_t affordable_stride(const Accelerator& accelerator, const PictureRays& picture, std::uint64_t most_steps) {
  constexpr std::uint32_t kCoarse = 24;
  const std::vector<std::uint32_t> pixels = PictureRays::pixels(kCoarse);
  TraversalCounts counts;
  for (const std::uint32_t pixel : pixels) static_cast<void>(accelerator.closest_hit(picture.rays()[pixel], &counts));
  const std::uint64_t steps_per_ray = steps_of(counts) / pixels.size() + 1;
  std::uint32_t stride = 1;
  while (stride < kCoarse / 3 && steps_per_ray * (picture.rays().size() / (std::uint64_t{stride} * stride)) > most_steps) stride *= 2;
  return stride;
}

RecordedRay place_steps(const ViewTree& tree, const std::vector<SceneStep>& steps, const Hit& hit) {
  RecordedRay ray;
  ray.hit = hit;
  const std::size_t count = std::min(steps.size(), kMostStepsOfRay);
  ray.is_cut = count < steps.size();
  ray.steps.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const TraversalStep& step = steps[i].step;
    const std::uint32_t instance = steps[i].instance;
    if (instance != kInvalidId && !tree.is_whole()) continue;
    PlacedStep& placed = ray.steps.emplace_back(PlacedStep{step.kind, step.octant});
    if (step.kind != TraversalStep::Kind::test) {
      placed.place = tree.find(steps[i]);
      continue;
    }
    placed.place = step.number;
    placed.instance = instance;
    placed.distance = steps[i].closest_after;
    placed.is_closest_yet = placed.distance < step.closest;
  }
  return ray;
}

std::uint64_t count_steps(const std::vector<SceneStep>& steps) {
  return static_cast<std::uint64_t>(
      std::ranges::count_if(steps, [](const SceneStep& step) { return step.step.kind != TraversalStep::Kind::leaf; }));
}

}  // namespace

StructureSample sample_structure(const Scene& scene, const SceneAccelerator& accelerator, const PictureRays& picture,
                                 std::uint64_t most_steps) {
  StructureSample sample{ViewTree(scene, accelerator), {}, {}};
  const std::uint32_t stride = affordable_stride(accelerator.top(), picture, most_steps);
  sample.picture.width = PictureRays::columns(stride);
  sample.picture.height = PictureRays::rows(stride);

  SceneWalks walks(scene, accelerator);
  std::vector<SceneStep> steps;
  const std::vector<std::uint32_t> pixels = PictureRays::pixels(stride);
  sample.picture.steps.reserve(pixels.size());
  for (const std::uint32_t pixel : pixels) {
    static_cast<void>(walks.record(picture.rays()[pixel], steps));
    sample.tree.count(steps);
    sample.picture.steps.push_back(static_cast<std::uint32_t>(count_steps(steps)));
  }
  sample.tree.sum_up();

  const std::vector<std::uint32_t> looked_at = PictureRays::pixels(PictureRays::kLeastStride);
  sample.recorded.reserve(looked_at.size());
  for (const std::uint32_t pixel : looked_at) {
    const Hit hit = walks.record(picture.rays()[pixel], steps);
    sample.recorded.push_back(place_steps(sample.tree, steps, hit));
  }
  return sample;
}

}  // namespace grove
