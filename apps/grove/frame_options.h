#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "grove/registry/update.h"
#include "grove/render/sequence/frame_renderer.h"
#include "grove/render/sequence/viewpoint.h"

namespace grove::app {

/// Which pictures of a scene that moves: the options of `grove render` as they are typed.
struct FrameOptions {
  std::string range;
  double frames_per_second = 30.0;
  std::optional<double> time;
  std::optional<std::string> animation;
  std::string update = "auto";
  double shutter = 0.0;
  std::uint32_t shutter_times = 0;
  bool loops = false;
  bool resumes = false;
  // From where.
  std::string eye;
  std::string look_at;
  std::string up;
  std::optional<double> field_of_view;
  std::optional<double> turn;  ///< degrees that `--camera orbit` turns by within the frames
};

void add_frame_options(CLI::App& verb, FrameOptions& options);

/// Frames first, first + 1, …, end - 1.
struct FrameRange {
  std::uint32_t first = 0;
  std::uint32_t end = 1;

  [[nodiscard]] std::uint32_t count() const { return end - first; }
};

/// The options, understood.
struct FramePlan {
  /// Several frames, or one with motion blur or a number in its name: pictures are made frame by frame.
  bool is_sequence = false;
  /// The scene is to be put to a time.
  bool is_posed = false;
  FrameRange range;
  double time = 0.0;  ///< of the picture, where it is one
  UpdatePolicy policy = UpdatePolicy::automatic;
  std::optional<Viewpoint> viewpoint;
  bool orbits = false;

  /// Seconds of the scene at which frame `number` begins.
  [[nodiscard]] double time_of(const FrameOptions& options, std::uint32_t number) const;
  /// What part of a turn round the scene is done at a time.
  [[nodiscard]] double turns_at(const FrameOptions& options, double at) const;
};

/// Understands the options, together with the camera and pictures that are asked for; clears `camera` where it is "orbit". Throws UsageError.
[[nodiscard]] FramePlan plan_frames(const FrameOptions& options, std::string& camera, const std::vector<std::string>& pictures);

/// The time within the animation that stands for `time`: the same, or with --loop that of its repetitions.
[[nodiscard]] double animation_time(const FrameOptions& options, const AnimatedScene& scene, double time);

}  // namespace grove::app
