#include "render_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "frame_names.h"
#include "grove/base/output_file.h"
#include "grove/base/timer.h"
#include "grove/lab/text_table.h"
#include "grove/render/view.h"
#include "progress_bar.h"
#include "session.h"
#include "verbs.h"

namespace grove::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint32_t kUsualShutterTimes = 8;
/// At how many times a sequence is looked at for what is to be in view.
constexpr std::uint32_t kViewTimes = 32;

AnimatedScene load_moving(const CommonOptions& common, const FrameOptions& options, const Console& console) {
  AnimatedScene scene = load_animated(common.scene, options.animation.value_or(""), console);
  if (const auto& animation = scene.animation()) {
    console.say(fmt::format("animation  {}{:g} s to {:g} s; {} of {} objects change shape, {} of {} instances move",
                            animation->name.empty() ? "" : "'" + animation->name + "', ", animation->begin, animation->end,
                            scene.deforming_object_count(), scene.scene().objects.size(), animation->instances.size(),
                            scene.scene().instances.size()));
  } else {
    console.warn("the scene has no animation; it is the same at all times");
  }
  return scene;
}

// What the scene takes up over all frames, so that a view of all of it stands still.
Box bounds_of(AnimatedScene& scene, const FrameCommand& command) {
  if (!scene.animation()) return scene.scene().bounds();
  Box bounds;
  const std::uint32_t count = command.plan.range.count();
  const std::uint32_t steps = std::min(count, kViewTimes);
  for (std::uint32_t i = 0; i < steps; ++i) {
    const auto frame = command.plan.range.first + static_cast<std::uint32_t>(std::uint64_t{i} * count / steps);
    scene.move_to(animation_time(command.frames, scene, command.plan.time_of(command.frames, frame)));
    bounds.grow(scene.scene().bounds());
  }
  return bounds;
}

std::string methods_text(const RenderedFrame& frame) {
  if (frame.is_built) return "built";
  if (frame.moved_objects == 0 && frame.moved_instances == 0) return "nothing moved";
  std::vector<UpdateMethod> methods;
  for (const UpdateReport& report : frame.update.objects) {
    if (std::ranges::find(methods, report.method) == methods.end()) methods.push_back(report.method);
  }
  std::string text;
  for (const UpdateMethod method : methods) {
    text += text.empty() ? "" : " and ";
    text += name_of(method);
  }
  if (frame.update.top) {
    text += text.empty() ? "" : ", ";
    text += "top level ";
    text += name_of(frame.update.top->method);
  }
  return text.empty() ? "nothing moved" : text;
}

Json update_json(const UpdateReport& report) {
  return {{"method", name_of(report.method)},
          {"cost", report.cost},
          {"built_cost", report.built_cost},
          {"rotations", report.rotations},
          {"seconds", report.seconds}};
}

class Sequence {
 public:
  Sequence(const FrameCommand& command, Interrupts& interrupts, const Console& console)
      : command_(command),
        interrupts_(interrupts),
        console_(console),
        scene_(load_moving(command.common, command.frames, console)),
        denoiser_(command.denoise) {}

  int run() {
    prepare();
    const Interrupts::Graceful graceful(interrupts_);
    FrameRenderer renderer(scene_, command_.common.structure, command_.plan.policy);
    const FrameRange& range = command_.plan.range;
    for (std::uint32_t number = range.first; number < range.end && !interrupts_.requested(); ++number) {
      if (is_there(number)) {
        denoiser_.skip();
      } else {
        make(renderer, number);
      }
    }
    if (!command_.common.json.empty()) write_json();
    if (finished_ == range.count()) return 0;
    fmt::print(stderr, "grove render: interrupted; {} of {} frames are finished{}\n", finished_, range.count(),
               command_.frames.range.empty() ? "" : "; the same command with --resume makes the others");
    return kInterrupted;
  }

 private:
  void prepare() {
    settings_ = command_.settings;
    set_sky(command_.sky, scene_.scene());
    const View view = choose_view(scene_.scene(), settings_);
    // What is not there is found before any work.
    for (std::uint32_t number = command_.plan.range.first; number < command_.plan.range.end; ++number) {
      ReferencePicture reference = command_.reference.of_frame(number);
      reference.read(view.width, view.height);
      if (!command_.reference.differs_by_frame()) break;
    }
    aspect_ = static_cast<float>(view.width) / static_cast<float>(view.height);
    viewpoint_ = command_.plan.viewpoint;
    // Without any camera all is shown.
    if (!viewpoint_ && settings_.camera.empty() && scene_.scene().cameras.empty()) viewpoint_.emplace();
    if (viewpoint_ && !(viewpoint_->eye && viewpoint_->target)) bounds_ = bounds_of(scene_, command_);
    // What is wrong with it is found before any work.
    if (viewpoint_) static_cast<void>(camera_at(*viewpoint_, bounds_, aspect_));
    exposure_.duration = command_.frames.shutter / command_.frames.frames_per_second;
    exposure_.times = command_.frames.shutter_times;
    if (exposure_.times == 0) exposure_.times = std::min(settings_.samples_per_pixel, kUsualShutterTimes);
  }

  [[nodiscard]] std::vector<std::string> files_of(std::uint32_t number) const {
    std::vector<std::string> files;
    files.reserve(command_.pictures.size());
    for (const std::string& picture : command_.pictures) files.push_back(frame_name(picture, number));
    return files;
  }

  [[nodiscard]] bool is_there(std::uint32_t number) {
    const std::vector<std::string> files = files_of(number);
    const bool is_there =
        command_.frames.resumes && std::ranges::all_of(files, [](const std::string& file) { return std::filesystem::exists(file); });
    if (is_there) {
      console_.say(fmt::format("frame {:4}  is there: {}", number, files.front()));
      ++finished_;
    }
    return is_there;
  }

  void make(FrameRenderer& renderer, std::uint32_t number) {
    const double time = command_.plan.time_of(command_.frames, number);
    exposure_.time = animation_time(command_.frames, scene_, time);
    std::function<Camera(double)> viewpoint;
    if (viewpoint_) {
      // The camera goes on turning where the animation begins again.
      const double offset = time - exposure_.time;
      viewpoint = [this, offset](double at) {
        return camera_at(*viewpoint_, bounds_, aspect_, command_.plan.turns_at(command_.frames, at + offset));
      };
    }
    RenderedFrame frame;
    RenderSettings settings = settings_;
    denoiser_.prepare(settings, number);
    {
      ProgressBar bar(fmt::format("frame {}", number), "samples", 1.0, command_.common.quiet);
      frame = renderer.render(settings, exposure_, bar.reporter(interrupts_.token()), viewpoint);
    }
    if (frame.picture.interrupted) return;
    for (const std::string& warning : frame.picture.warnings) {
      if (std::ranges::find(warnings_, warning) != warnings_.end()) continue;
      warnings_.push_back(warning);
      console_.warn(warning);
    }
    if (viewpoint) settings.viewpoint = viewpoint(exposure_.time);
    const double denoise_seconds = denoiser_.finish(frame.picture, settings, scene_.scene());
    ReferencePicture reference = command_.reference.of_frame(number);
    reference.read(frame.picture.film.width(), frame.picture.film.height());
    reference.compare(frame.picture.colours(), command_.display, Console(true));
    const std::vector<std::string> files = files_of(number);
    const Timer writing;
    command_.write(files, frame.picture, settings, scene_.scene(), *renderer.accelerator());
    const double write_seconds = writing.seconds();
    ++finished_;
    report({frame, number, time, files, reference, denoise_seconds, write_seconds});
  }

  // A frame that is finished.
  struct Finished {
    const RenderedFrame& frame;
    std::uint32_t number;
    double time;
    const std::vector<std::string>& files;
    const ReferencePicture& reference;
    double denoise_seconds;
    double write_seconds;
  };

  // Of a frame's time: what went into it, on the wall's clock, where that is known.
  [[nodiscard]] static std::string split_text(const Finished& done) {
    const RenderResult& picture = done.frame.picture;
    if (!(picture.trace_seconds > 0.0)) return {};
    const auto threads = static_cast<double>(arena_threads());
    std::string text =
        fmt::format(" (trace {}, shade {}", duration(picture.trace_seconds / threads), duration(picture.shade_seconds / threads));
    if (done.denoise_seconds > 0.0) text += fmt::format(", then denoise {}", duration(done.denoise_seconds));
    return text + ")";
  }

  void report(const Finished& done) {
    const RenderedFrame& frame = done.frame;
    const RenderResult& picture = frame.picture;
    const double mrays = picture.seconds > 0.0 ? 1e-6 * static_cast<double>(picture.rays_traced) / picture.seconds : 0.0;
    const double update_seconds = frame.is_built ? frame.build_seconds : frame.update.seconds;
    console_.say(fmt::format("frame {:4}  {:.3f} s: moved in {}, {} in {}, cost x {:.2f}; {} rays in {}{}: {} Mrays/s; {}", done.number,
                             done.time, duration(frame.pose_seconds), methods_text(frame), duration(update_seconds),
                             frame.update.cost_growth, with_separators(picture.rays_traced), duration(picture.seconds), split_text(done),
                             short_number(mrays), done.files.front()));
    if (const std::string difference = done.reference.text(); !difference.empty()) console_.say("difference " + difference);
    Json json = {{"frame", done.number},
                 {"time", done.time},
                 {"moved_instances", frame.moved_instances},
                 {"moved_objects", frame.moved_objects},
                 {"built", frame.is_built},
                 {"cost_growth", frame.update.cost_growth},
                 {"pose_seconds", frame.pose_seconds},
                 {"build_seconds", frame.build_seconds},
                 {"update_seconds", frame.update.seconds},
                 {"render_seconds", picture.seconds},
                 {"prepare_seconds", picture.prepare_seconds},
                 {"trace_seconds", picture.trace_seconds},
                 {"shade_seconds", picture.shade_seconds},
                 {"gather_seconds", picture.gather_seconds},
                 {"denoise_seconds", done.denoise_seconds},
                 {"write_seconds", done.write_seconds},
                 {"rays", picture.rays_traced},
                 {"mrays_per_s", mrays},
                 {"dropped_samples", picture.dropped_samples},
                 {"images", done.files}};
    json["objects"] = Json::array();
    for (const UpdateReport& object : frame.update.objects) json["objects"].push_back(update_json(object));
    if (frame.update.top) json["top_level"] = update_json(*frame.update.top);
    if (Json comparison = done.reference.figures(); !comparison.is_null()) json["comparison"] = std::move(comparison);
    rows_.push_back(std::move(json));
    width_ = picture.film.width();
    height_ = picture.film.height();
  }

  void write_json() const {
    const auto& animation = scene_.animation();
    const Json json = {{"format", "grove-frames"},
                       {"version", 1},
                       {"scene", command_.common.scene},
                       {"animation", animation ? Json(animation->name) : Json()},
                       {"animation_seconds", animation ? Json({animation->begin, animation->end}) : Json()},
                       {"structure", command_.common.structure},
                       {"update", name_of(command_.plan.policy)},
                       {"primitives", scene_.scene().primitive_count()},
                       {"threads", arena_threads()},
                       {"load_seconds", scene_.scene().load_seconds},
                       {"fps", command_.frames.frames_per_second},
                       {"first", command_.plan.range.first},
                       {"end", command_.plan.range.end},
                       {"complete", finished_ == command_.plan.range.count()},
                       {"width", width_},
                       {"height", height_},
                       {"samples_per_pixel", settings_.samples_per_pixel},
                       {"max_depth", settings_.max_depth},
                       {"seed", settings_.seed},
                       {"integrator", command_.integrator},
                       {"denoise", command_.denoise.text},
                       {"shutter", command_.frames.shutter},
                       {"shutter_times", exposure_.duration > 0.0 ? exposure_.times : 1},
                       {"frames", rows_}};
    write_text_file(command_.common.json, json.dump(2) + "\n");
  }

  const FrameCommand& command_;
  Interrupts& interrupts_;
  const Console& console_;
  AnimatedScene scene_;
  FrameDenoiser denoiser_;
  RenderSettings settings_;
  std::optional<Viewpoint> viewpoint_;
  Box bounds_;
  float aspect_ = 1.0F;
  Exposure exposure_;
  std::uint32_t finished_ = 0;
  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
  std::vector<std::string> warnings_;
  std::vector<Json> rows_;
};

}  // namespace

int render_frames(const FrameCommand& command, Interrupts& interrupts, const Console& console) {
  return Sequence(command, interrupts, console).run();
}

Scene load_posed(const CommonOptions& common, const FrameOptions& options, const FramePlan& plan, const Console& console) {
  AnimatedScene scene = load_moving(common, options, console);
  scene.move_to(animation_time(options, scene, plan.time));
  return std::move(scene.scene());
}

}  // namespace grove::app
