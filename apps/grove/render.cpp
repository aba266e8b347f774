#include "grove/render/render.h"

#include <fmt/format.h>

#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "checkpoint.h"
#include "denoise_options.h"
#include "display_options.h"
#include "frame_names.h"
#include "frame_options.h"
#include "grove/base/error.h"
#include "grove/base/output_file.h"
#include "grove/lab/structure_report.h"
#include "grove/lab/text_table.h"
#include "grove/render/view.h"
#include "layer_options.h"
#include "picture_files.h"
#include "picture_part_options.h"
#include "progress_bar.h"
#include "reference_picture.h"
#include "render_frames.h"
#include "sampling_options.h"
#include "sampling_report.h"
#include "session.h"
#include "sky_option.h"
#include "verbs.h"

namespace grove::app {
namespace {

constexpr std::uint64_t kLargestSide = 65'536;
constexpr std::uint64_t kMostSamples = 1 << 20;
constexpr std::uint64_t kMostDepth = 1024;

struct RenderOptions : CommonOptions {
  std::vector<std::string> pictures;
  std::string integrator = "path";
  RenderSettings settings;
  SamplingOptions sampling;
  const CLI::Option* samples_per_pixel = nullptr;
  DisplayOptions display;
  LayerOptions layers;
  DenoiseOptions denoise;
  SkyOption sky;
  ReferencePicture reference;
  std::optional<std::string> tile;
  std::optional<std::string> samples;
  std::filesystem::path checkpoint;
  double checkpoint_interval = 60.0;
  bool restarts = false;
  bool asks_single_rays = false;
  FrameOptions frames;
  FramePlan plan;
};

// A sequence has its own files, one a frame; what makes parts of one picture does not go with it.
void check_frames(const RenderOptions& options) {
  if (!options.checkpoint.empty())
    throw UsageError("--checkpoint: saves one picture, not frames; leave it out, and go on after an interruption with --resume");
  static_cast<void>(options.reference.differs_by_frame());  // finds a bad name
  if (options.frames.shutter <= 0.0) return;
  if (options.denoise.way != Denoise::off)
    throw UsageError("--denoise: does not go with --shutter, whose frames show several times at once; leave one out");
  if (options.samples)
    throw UsageError("--samples: does not go with --shutter, which spreads the samples over time; render parts with --tile");
  if (options.sampling.noise || options.sampling.time_limit)
    throw UsageError("--shutter: spreads a number of samples over time; give it by --spp, without --noise and --time-limit");
  if (has_film(options.pictures)) throw UsageError("-o: a .film cannot hold a picture with --shutter; write .exr instead");
}

// Whatever can be found wrong before the scene is read.
void check_command(RenderOptions& options) {
  options.settings.integrator = integrator_from_name(options.integrator);
  apply_sampling(options.sampling, options.samples_per_pixel->count() > 0, options.samples.has_value(), options.settings);
  if (options.asks_single_rays) options.settings.ray_calls = RayCalls::single;
  if (options.tile) parse_tile(*options.tile, options.settings.part);
  if (options.samples) parse_samples(*options.samples, options.settings.samples_per_pixel, options.settings.part);
  parse_display(options.display);
  parse_layers(options.layers);
  if (has_exr(options.pictures)) ask_for_layers(options.layers, options.settings.gathering);
  parse_denoise(options.denoise, options.settings);
  parse_sky(options.sky);
  options.plan = plan_frames(options.frames, options.settings.camera, options.pictures);
  std::vector<std::string> first;
  first.reserve(options.pictures.size());
  for (const std::string& picture : options.pictures) first.push_back(frame_name(picture, options.plan.range.first));
  check_pictures(first);
  if (options.plan.is_sequence) {
    check_frames(options);
  } else if (options.denoise.way == Denoise::temporal) {
    throw UsageError("--denoise: temporal needs frames that follow each other; ask for some by --frames, or use spatial");
  }
  if (!options.plan.is_sequence) options.pictures = std::move(first);
  for (const std::string& picture : options.pictures) {
    const std::filesystem::path path = std::filesystem::path(picture).lexically_normal();
    if (path != options.checkpoint.lexically_normal() || has_film({picture})) continue;
    throw UsageError(fmt::format("--checkpoint: '{}' is the picture's name too; name another, such as {}", picture,
                                 std::filesystem::path(picture).replace_extension(".film").string()));
  }
  if (!options.json.empty()) check_writable(options.json);
}

void write_figures(const RenderOptions& options, const RenderResult& result, const SamplingReport& report,
                   const StructureStatistics& statistics, const Scene& scene, const std::string& spec, double denoise_seconds) {
  nlohmann::ordered_json json = structure_json(spec, statistics, arena_threads());
  json["scene"] = options.scene;
  json["load_seconds"] = scene.load_seconds;
  json["width"] = result.film.width();
  json["height"] = result.film.height();
  json["samples_per_pixel"] = options.settings.samples_per_pixel;
  json["max_depth"] = options.settings.max_depth;
  json["seed"] = options.settings.seed;
  json["integrator"] = options.integrator;
  json["camera"] = result.camera;
  json["rays"] = result.rays_traced;
  json["render_seconds"] = result.seconds;
  json["mrays_per_s"] = result.seconds > 0.0 ? 1e-6 * static_cast<double>(result.rays_traced) / result.seconds : 0.0;
  report.add_to(json);
  json["denoise"] = options.denoise.text;
  json["denoise_seconds"] = denoise_seconds;
  json["completed_fraction"] = result.completed_fraction;
  json["interrupted"] = result.interrupted;
  json["tiles"] = {{"share", result.part.share}, {"of", result.part.share_count}};
  json["samples"] = {{"first", result.part.first_sample}, {"end", result.part.end_sample}};
  json["images"] = options.pictures;
  if (auto comparison = options.reference.figures(); !comparison.is_null()) json["comparison"] = std::move(comparison);
  write_text_file(options.json, json.dump(2) + "\n");
}

int run_frames(const RenderOptions& options, Interrupts& interrupts, const Console& console) {
  const auto write = [&](const std::vector<std::string>& files, const RenderResult& result, const RenderSettings& settings,
                         const Scene& scene, const SceneAccelerator& accelerator) {
    FilmHeader header;
    if (has_film(files)) header = film_header(options.scene, scene, accelerator, settings);
    write_pictures(files, result, {.display = options.display.settings, .layers = options.layers.layers}, header, Console(true));
  };
  return render_frames({options, options.frames, options.plan, options.pictures, options.settings, options.integrator, options.denoise,
                        options.reference, options.display.settings, options.sky, write},
                       interrupts, console);
}

// The scene as it is read, or at the time that is asked for; a viewpoint goes into the settings.
Scene load_for_picture(RenderOptions& options, const Console& console) {
  Scene scene = options.plan.is_posed ? load_posed(options, options.frames, options.plan, console) : load(options.scene, console);
  set_sky(options.sky, scene);
  if (!options.plan.viewpoint) return scene;
  const View view = choose_view(scene, options.settings);
  options.settings.viewpoint =
      camera_at(*options.plan.viewpoint, scene.bounds(), static_cast<float>(view.width) / static_cast<float>(view.height));
  return scene;
}

int run(RenderOptions& options, Interrupts& interrupts) {
  const Console console(options.quiet);
  const std::string spec = canonical_spec(options.structure);
  check_command(options);
  if (options.plan.is_sequence) return run_frames(options, interrupts, console);
  Checkpoint checkpoint(options.checkpoint, options.restarts, options.checkpoint_interval);

  const Scene scene = load_for_picture(options, console);
  const View view = choose_view(scene, options.settings);
  options.reference.read(view.width, view.height);
  const BuiltStructure built = build_structure(scene, spec, console);
  FilmHeader header;
  if (checkpoint.is_on() || has_film(options.pictures)) header = film_header(options.scene, scene, built.accelerator, options.settings);
  const Interrupts::Graceful graceful(interrupts);
  RenderResult result;
  {
    RenderCheckpoints checkpoints = checkpoint.begin(header, console);
    ProgressBar bar("rendering", "samples", 1.0, options.quiet);
    result = render(scene, built.accelerator, options.settings, bar.reporter(interrupts.token()), std::move(checkpoints));
  }
  for (const std::string& warning : result.warnings) console.warn(warning);
  const SamplingReport report(result, options.settings);
  console.say(fmt::format("picture    {} x {} pixels, {}, {}", result.film.width(), result.film.height(), report.samples(), report.work()));
  if (const std::string remark = report.remark(); !remark.empty()) console.say("noise      " + remark);
  checkpoint.finish(result, console);
  const double denoise_seconds = denoise_still(options.denoise, result, console);
  write_pictures(options.pictures, result, {.display = options.display.settings, .layers = options.layers.layers}, header, console);
  options.reference.compare(result.colours(), options.display.settings, console);
  if (!options.json.empty()) write_figures(options, result, report, built.statistics, scene, spec, denoise_seconds);
  checkpoint.rethrow_failure();
  if (!result.interrupted) return 0;
  fmt::print(stderr, "grove render: interrupted; wrote what was finished, {:.1f} % of the samples{}\n", 100.0 * result.completed_fraction,
             checkpoint.is_on() ? "; the same command goes on from " + options.checkpoint.string() : "");
  return kInterrupted;
}

}  // namespace

Verb add_render(CLI::App& program) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App& verb = *program.add_subcommand("render", "Path-trace a scene to an image");
  RenderSettings& settings = options->settings;
  add_scene(verb, *options);
  verb.add_option("-o,--output", options->pictures,
                  "Picture to write: .exr (linear, with albedo and normal layers), .png, or .film (for 'grove merge'); may be repeated")
      ->required()
      ->type_name("PICTURE")
      ->allow_extra_args(false);
  add_structure(verb, *options);
  options->samples_per_pixel =
      in_range(verb.add_option("--spp", settings.samples_per_pixel, "Samples per pixel")->type_name("N")->capture_default_str(),
               std::uint64_t{1}, kMostSamples);
  in_range(verb.add_option("--width", settings.width, "Pixels across (default: as the scene says, else 1280)")->type_name("W"),
           std::uint64_t{1}, kLargestSide);
  in_range(verb.add_option("--height", settings.height, "Pixels down (default: as the scene says, else 720); one alone keeps the aspect")
               ->type_name("H"),
           std::uint64_t{1}, kLargestSide);
  in_range(verb.add_option("--max-depth", settings.max_depth, "Most surfaces that light scatters at: 0 emission, 1 direct light")
               ->type_name("D")
               ->capture_default_str(),
           std::uint64_t{0}, kMostDepth);
  in_range(verb.add_option("--seed", settings.seed, "Another seed, other noise; the same seed, the same image")
               ->type_name("S")
               ->capture_default_str(),
           std::uint64_t{0}, std::numeric_limits<std::uint64_t>::max());
  add_threads(verb, *options);
  verb.add_option("--camera", settings.camera,
                  "Name of a camera of the scene (default: its first, else a view of everything), or orbit, which turns round the scene in "
                  "--frames")
      ->type_name("NAME");
  verb.add_option("--integrator", options->integrator, "What pixels show: path, ao, normal, depth or cost")
      ->type_name("NAME")
      ->capture_default_str();
  add_sampling(verb, options->sampling);
  verb.add_flag("--single-rays", options->asks_single_rays,
                "Ask the structure about one ray after another instead of batches: slower, the same picture");
  add_display(verb, options->display);
  add_layers(verb, options->layers);
  add_denoise(verb, options->denoise);
  add_sky(verb, options->sky);
  options->reference.add_option(verb);
  verb.add_option("--tile", options->tile,
                  "Render the i-th of N shares of the picture's tiles, 1/N to N/N; 'grove merge' puts films together")
      ->type_name("i/N");
  verb.add_option("--samples", options->samples, "Render samples a to b - 1 of each pixel, of the --spp that there are from 0 on")
      ->type_name("a:b");
  CLI::Option* const checkpoint =
      verb.add_option("--checkpoint", options->checkpoint,
                      "Save the film to this file at intervals, when interrupted and at the end; where "
                      "it is there already, go on from it")
          ->type_name("FILE")
          ->check(CLI::Validator([](const std::string& text) { return text.empty() ? "a file name is missing" : ""; }, ""));
  in_range(verb.add_option("--checkpoint-interval", options->checkpoint_interval, "Seconds from one saving to the next")
               ->type_name("SECONDS")
               ->capture_default_str()
               ->needs(checkpoint),
           0.1, 1e6);
  verb.add_flag("--restart", options->restarts, "Do not go on from the checkpoint file, but replace it")->needs(checkpoint);
  add_frame_options(verb, options->frames);
  add_json(verb, *options, "the figures");
  add_quiet(verb, *options);
  verb.footer(
      "Ctrl-C writes the picture with the samples that it has and exits with 130; with --checkpoint, the same command goes on.\n\n"
      "Examples:\n"
      "  grove render builtin:cornell -o cornell.png\n"
      "  grove render scene.glb -o scene.exr -o scene.png --spp 256 --width 1920 --height 1080\n"
      "  grove render scene.glb -o scene.exr --spp 4096 --checkpoint scene.film\n"
      "  grove render scene.glb -o scene.png --noise 0.02 --time-limit 600\n"
      "  grove render scene.glb -o part2.film --tile 2/4\n"
      "  grove render scene.glb -o frame.%04d.png --frames 0:120 --fps 30 --spp 16\n"
      "  grove render scene.glb -o clean.png --spp 8 --denoise spatial --compare scene.exr\n"
      "  grove render builtin:sphereflake -o cost.png --integrator cost --structure bvh --spp 4");
  return {&verb, [options](Interrupts& interrupts) { return with_threads(options->threads, [&] { return run(*options, interrupts); }); }};
}

}  // namespace grove::app
