#include "frame_options.h"

#include <fmt/format.h>

#include <CLI/Option.hpp>
#include <charconv>
#include <cmath>

#include "frame_names.h"
#include "grove/base/error.h"
#include "options.h"

namespace grove::app {
namespace {

constexpr std::uint32_t kMostFrames = 1'000'000;
constexpr double kLatest = 1e6;
constexpr double kDegreesPerTurn = 360.0;
constexpr double kMostTurning = 3.6e6;
constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;

FrameRange parse_range(const std::string& text) {
  FrameRange range;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, range.first);
  const bool has_colon = first.ec == std::errc() && first.ptr != end && *first.ptr == ':';
  const auto second = has_colon ? std::from_chars(first.ptr + 1, end, range.end) : first;
  if (!has_colon || second.ec != std::errc() || second.ptr != end || range.first >= range.end || range.end > kMostFrames) {
    throw UsageError(
        fmt::format("--frames: '{}' is no range a:b; 0:120 is frames 0 to 119, and {} is the last that may be", text, kMostFrames));
  }
  return range;
}

std::optional<Viewpoint> parse_viewpoint(const FrameOptions& options, const std::string& camera, bool orbits) {
  const bool describes = !options.eye.empty() || !options.look_at.empty() || !options.up.empty() || options.field_of_view.has_value();
  if (!orbits && options.eye.empty()) {
    if (!options.look_at.empty()) throw UsageError("--look-at: from where? name an --eye x,y,z, or --camera orbit");
    if (!options.up.empty()) throw UsageError("--up: goes with --eye x,y,z or --camera orbit");
    if (options.field_of_view) throw UsageError("--fov: goes with --eye x,y,z or --camera orbit; cameras of the scene have their own");
  }
  if (!orbits && !describes) return std::nullopt;
  if (!camera.empty()) throw UsageError(fmt::format("--eye: goes without --camera {}; take one of them", camera));
  Viewpoint viewpoint;
  if (!options.eye.empty()) viewpoint.eye = parse_vector("--eye", options.eye, "x,y,z");
  if (!options.look_at.empty()) viewpoint.target = parse_vector("--look-at", options.look_at, "x,y,z");
  if (!options.up.empty()) viewpoint.up = parse_vector("--up", options.up, "x,y,z");
  if (options.field_of_view) viewpoint.field_of_view = static_cast<float>(*options.field_of_view * kRadiansPerDegree);
  return viewpoint;
}

}  // namespace

void add_frame_options(CLI::App& verb, FrameOptions& options) {
  CLI::Option* const frames =
      verb.add_option("--frames", options.range,
                      "Render frames a to b - 1 of an animation, each to its own file: -o name.%04d.png has the number's place")
          ->type_name("a:b");
  in_range(verb.add_option("--fps", options.frames_per_second, "Frames a second: frame i is at i / FPS")
               ->type_name("FPS")
               ->capture_default_str(),
           0.001, 1e6);
  in_range(verb.add_option("--time", options.time, "Render the scene at this time of its animation, in seconds")->type_name("T"), -kLatest,
           kLatest)
      ->excludes(frames);
  verb.add_option("--animation", options.animation, "Which animation of the scene plays: its name or number (default: the first)")
      ->type_name("NAME|N");
  verb.add_flag("--loop", options.loops, "Begin the animation again at its end, instead of staying there");
  verb.add_option("--update", options.update,
                  "How structures follow what moves: auto, refit, rotate or rebuild; it does not change the picture")
      ->type_name("WAY")
      ->capture_default_str();
  in_range(
      verb.add_option("--shutter", options.shutter, "Motion blur: for what part of a frame's time the shutter is open, from its beginning")
          ->type_name("FRACTION")
          ->capture_default_str(),
      0.0, 1.0);
  in_range(verb.add_option("--shutter-times", options.shutter_times,
                           "At how many times the scene is looked at while the shutter is open (default: 8, or --spp where that is less)")
               ->type_name("K"),
           std::uint64_t{1}, std::uint64_t{65'536});
  verb.add_flag("--resume", options.resumes, "Leave out the frames whose files are there already")->needs(frames);
  verb.add_option("--eye", options.eye, "Look from this point instead of from a camera of the scene")->type_name("x,y,z");
  verb.add_option("--look-at", options.look_at,
                  "Look at this point, or turn round it with --camera orbit (default: the middle of the scene)")
      ->type_name("x,y,z");
  verb.add_option("--up", options.up, "What is up for --eye and --camera orbit (default: 0,1,0)")->type_name("x,y,z");
  in_range(verb.add_option("--fov", options.field_of_view, "Field of view from bottom to top for --eye and --camera orbit (default: 34.4)")
               ->type_name("DEGREES"),
           0.1, 179.0);
  in_range(verb.add_option("--turn", options.turn,
                           "How far --camera orbit turns within --frames, counter-clockwise seen from above (default: 360, once round)")
               ->type_name("DEGREES"),
           -kMostTurning, kMostTurning);
}

FramePlan plan_frames(const FrameOptions& options, std::string& camera, const std::vector<std::string>& pictures) {
  FramePlan plan;
  plan.policy = parse_update_policy(options.update);
  plan.orbits = camera == "orbit";
  if (plan.orbits) camera.clear();
  if (options.turn && !plan.orbits) throw UsageError("--turn: says how far --camera orbit turns; name that camera");
  plan.viewpoint = parse_viewpoint(options, camera, plan.orbits);
  plan.time = options.time.value_or(0.0);
  plan.is_posed = options.time || options.animation || options.loops || options.shutter > 0.0;
  if (!options.range.empty()) {
    plan.range = parse_range(options.range);
    plan.is_posed = true;
  }
  plan.is_sequence = !options.range.empty() || options.shutter > 0.0;
  for (const std::string& name : pictures) {
    const bool has_number = has_frame_number(name);
    if (has_number && options.range.empty()) {
      throw UsageError(
          fmt::format("-o: '{}' has a place for the number of a frame; say which with --frames a:b, or write %% for a percent sign", name));
    }
    if (!has_number && plan.range.count() > 1) {
      throw UsageError(fmt::format("-o: '{}' has no place for the number of the frame; {} frames need one, such as name.%04d.png", name,
                                   plan.range.count()));
    }
  }
  return plan;
}

double FramePlan::time_of(const FrameOptions& options, std::uint32_t number) const {
  return options.range.empty() ? time : number / options.frames_per_second;
}

double FramePlan::turns_at(const FrameOptions& options, double at) const {
  if (!orbits || options.range.empty()) return 0.0;
  const double whole = options.turn.value_or(kDegreesPerTurn) / kDegreesPerTurn;
  return whole * (at * options.frames_per_second - range.first) / range.count();
}

double animation_time(const FrameOptions& options, const AnimatedScene& scene, double time) {
  if (!options.loops || !scene.animation()) return time;
  const double begin = scene.animation()->begin;
  const double length = scene.animation()->end - begin;
  if (!(length > 0.0)) return time;
  return begin + (time - begin) - std::floor((time - begin) / length) * length;
}

}  // namespace grove::app
