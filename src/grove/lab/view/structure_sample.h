#pragma once

#include <cstdint>
#include <vector>

#include "grove/lab/view/picture_rays.h"
#include "grove/lab/view/view_tree.h"
#include "grove/render/scene_accelerator.h"

namespace grove {

/// A step of a recorded ray, its node found.
struct PlacedStep {
  TraversalStep::Kind kind;
  std::uint8_t octant = 0;              ///< of a gap
  bool is_closest_yet = false;          ///< of a test: the primitive was hit, and closer than what had been
  std::uint32_t place = 0;              ///< in ViewTree::nodes(); of a test the primitive in its object
  std::uint32_t instance = kInvalidId;  ///< of a test in the structure of an instance's object
  float distance = 0.0F;                ///< of a test that was closest yet: of its hit
};

/// What one ray did.
struct RecordedRay {
  std::vector<PlacedStep> steps;
  Hit hit;
  bool is_cut = false;  ///< there were more steps than are kept
};

/// How many steps each of the rays took, in nodes and tests.
struct StepPicture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint32_t> steps;
};

/// What the rays of a picture do in a structure.
struct StructureSample {
  ViewTree tree;                      ///< with visits and tests, summed up
  StepPicture picture;                ///< of every ray, or of fewer where they take too many steps
  std::vector<RecordedRay> recorded;  ///< those of PictureRays::pixels(kLeastStride)
};

/// Most steps of a recorded ray that are kept.
inline constexpr std::size_t kMostStepsOfRay = 4000;

/// Traces the picture, fewer rays of it where all together would take more than `most_steps` steps. In the calling thread.
[[nodiscard]] StructureSample sample_structure(const Scene& scene, const SceneAccelerator& accelerator, const PictureRays& picture,
                                               std::uint64_t most_steps = 50'000'000);

}  // namespace grove
