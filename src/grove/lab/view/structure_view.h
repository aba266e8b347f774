#pragma once

// The data of the page that shows structures (`grove inspect --html`).

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "grove/lab/view/node_selection.h"
#include "grove/lab/view/picture_rays.h"
#include "grove/lab/view/structure_sample.h"
#include "grove/render/scene_accelerator.h"
#include "grove/scene/scene.h"

namespace grove {

/// Collects what a page shows of structures over one scene, one after another, so that only one has to be in memory. docs/inspect-view.md describes the data.
class StructureView {
 public:
  /// `structure_count` is how many will be added: they share the room in the page. The scene must stay as it is. Throws as CameraRays does.
  StructureView(const Scene& scene, const Camera& camera, std::size_t structure_count);

  /// Samples and keeps a structure over the scene; `figures` is its structure_json. Throws UsageError where it has no nodes to show.
  void add(const SceneAccelerator& accelerator, nlohmann::ordered_json figures);

  /// All that was added: format "grove-inspect". `source` is what the scene was loaded from.
  [[nodiscard]] nlohmann::ordered_json json(std::string_view source, const std::string& command) const;

 private:
  // The coarsest that a structure needs: then the same rays are there for all.
  [[nodiscard]] std::uint32_t stride() const;

  const Scene& scene_;
  PictureRays picture_;
  ViewLimits limits_;
  std::vector<std::uint8_t> shades_;  // once there is a structure
  // Each structure but its traces, and the rays that those are made of, their nodes by index in the page.
  std::vector<nlohmann::ordered_json> structures_;
  std::vector<std::vector<RecordedRay>> recorded_;
  std::vector<std::uint32_t> strides_;
};

}  // namespace grove
