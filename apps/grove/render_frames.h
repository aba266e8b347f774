#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "console.h"
#include "denoise_options.h"
#include "frame_options.h"
#include "interrupts.h"
#include "options.h"
#include "reference_picture.h"
#include "sky_option.h"

namespace grove::app {

/// What of `grove render` makes frames.
struct FrameCommand {
  const CommonOptions& common;
  const FrameOptions& frames;
  const FramePlan& plan;
  const std::vector<std::string>& pictures;
  const RenderSettings& settings;
  const std::string& integrator;
  const DenoiseOptions& denoise;
  const ReferencePicture& reference;
  const DisplaySettings& display;
  const SkyOption& sky;
  /// Writes a picture to these files, and says nothing. The settings are those it was made with.
  std::function<void(const std::vector<std::string>& files, const RenderResult&, const RenderSettings&, const Scene&,
                     const SceneAccelerator&)>
      write;
};

/// Renders the frames in order and writes each as soon as it is whole. Returns the exit code.
int render_frames(const FrameCommand& command, Interrupts& interrupts, const Console& console);

/// A scene put to the plan's time, for a single picture.
[[nodiscard]] Scene load_posed(const CommonOptions& common, const FrameOptions& options, const FramePlan& plan, const Console& console);

}  // namespace grove::app
