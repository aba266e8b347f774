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

RecordedRay place_steps(const ViewTree& tree, const TraversalRecord& record, const Hit& hit) {
  RecordedRay ray;
  ray.hit = hit;
  const std::size_t count = std::min(record.steps.size(), kMostStepsOfRay);
  ray.is_cut = count < record.steps.size();
  ray.steps.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const TraversalStep& step = record.steps[i];
    PlacedStep& placed = ray.steps.emplace_back(PlacedStep{step.kind, step.octant});
    if (step.kind != TraversalStep::Kind::test) {
      placed.place = tree.find(step);
      continue;
    }
    placed.place = step.number;
    // Each step tells what was closest before it.
    placed.distance = i + 1 < record.steps.size() ? record.steps[i + 1].closest : hit.t;
    placed.is_closest_yet = hit && placed.distance < step.closest;
  }
  return ray;
}

}  // namespace

StructureSample sample_structure(const Accelerator& accelerator, const PictureRays& picture, std::uint64_t most_steps) {
  StructureSample sample{ViewTree(accelerator), {}, {}, 0};
  const std::uint32_t stride = affordable_stride(accelerator, picture, most_steps);
  sample.picture.width = PictureRays::columns(stride);
  sample.picture.height = PictureRays::rows(stride);

  TraversalRecord record;
  const std::vector<std::uint32_t> pixels = PictureRays::pixels(stride);
  sample.picture.steps.reserve(pixels.size());
  for (const std::uint32_t pixel : pixels) {
    static_cast<void>(accelerator.record_steps(picture.rays()[pixel], record));
    sample.tree.count(record.steps);
    const auto leaves = std::ranges::count(record.steps, TraversalStep::Kind::leaf, &TraversalStep::kind);
    const std::uint64_t steps = record.steps.size() - static_cast<std::size_t>(leaves) + steps_of(record.nested);
    sample.picture.steps.push_back(static_cast<std::uint32_t>(steps));
    sample.nested_tests += record.nested.primitives_tested;
  }
  sample.tree.sum_up();

  const std::vector<std::uint32_t> looked_at = PictureRays::pixels(PictureRays::kLeastStride);
  sample.recorded.reserve(looked_at.size());
  for (const std::uint32_t pixel : looked_at) {
    const Hit hit = accelerator.record_steps(picture.rays()[pixel], record);
    sample.recorded.push_back(place_steps(sample.tree, record, hit));
  }
  return sample;
}

}  // namespace grove
