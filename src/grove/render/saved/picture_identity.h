#pragma once

#include <string>
#include <vector>

#include "grove/render/scene_accelerator.h"
#include "grove/scene/scene.h"

namespace grove {

struct RenderSettings;

/// All that decides what the samples of a picture are: version of Grove, a fingerprint of the scene, view, seed and so on, but neither how many
/// samples nor which. Samples of the same identity may be added up.
struct PictureIdentity {
  struct Fact {
    std::string name;
    std::string value;
  };
  std::vector<Fact> facts;
};

/// Throws what choose_view throws. Takes as long as `fingerprint`.
[[nodiscard]] PictureIdentity picture_identity(const Scene& scene, const SceneAccelerator& accelerator, const RenderSettings& settings);

/// The value of a fact; empty where there is none of this name.
[[nodiscard]] std::string fact_of(const PictureIdentity& picture, const std::string& name);

/// What sets two pictures apart, such as "seed 1 instead of 0", `there` named first; empty when nothing does.
[[nodiscard]] std::string difference(const PictureIdentity& there, const PictureIdentity& here);

}  // namespace grove
