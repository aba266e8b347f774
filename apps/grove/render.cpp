#include "grove/render/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "grove/base/error.h"
#include "grove/base/output_file.h"
#include "grove/lab/structure_report.h"
#include "grove/lab/text_table.h"
#include "grove/render/image/write_exr.h"
#include "grove/render/image/write_png.h"
#include "progress_bar.h"
#include "session.h"
#include "verbs.h"

namespace grove::app {
namespace {

constexpr std::uint64_t kLargestSide = 65'536;
constexpr std::uint64_t kMostSamples = 1 << 20;
constexpr std::uint64_t kMostDepth = 1024;

struct RenderOptions : CommonOptions {
  std::vector<std::string> images;
  std::string integrator = "path";
  RenderSettings settings;
  DisplaySettings display;
};

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return extension;
}

void check_outputs(const RenderOptions& options) {
  for (const std::string& image : options.images) {
    const std::string extension = extension_of(image);
    if (extension != ".exr" && extension != ".png") {
      throw UsageError("--output: '" + image + "' has an unknown extension; images are written as .exr (linear) or .png (for the eye)");
    }
  }
  for (const std::string& image : options.images) check_writable(image);
  if (!options.json.empty()) check_writable(options.json);
}

void write_images(const RenderOptions& options, const RenderResult& result, const Console& console) {
  for (const std::string& image : options.images) {
    console.status("writing " + image);
    if (extension_of(image) == ".exr") {
      write_exr(result.film, image);
    } else {
      write_png(result, options.display, image);
    }
    console.say("wrote      " + image);
  }
}

void write_figures(const RenderOptions& options, const RenderResult& result, const StructureStatistics& statistics, const Scene& scene,
                   const std::string& spec) {
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
  json["completed_fraction"] = result.completed_fraction;
  json["interrupted"] = result.interrupted;
  json["images"] = options.images;
  write_text_file(options.json, json.dump(2) + "\n");
}

int run(RenderOptions& options, Interrupts& interrupts) {
  const Console console(options.quiet);
  const std::string spec = canonical_spec(options.structure);
  options.settings.integrator = integrator_from_name(options.integrator);
  check_outputs(options);

  const Scene scene = load(options.scene, console);
  const BuiltStructure built = build_structure(scene, spec, console);
  const Interrupts::Graceful graceful(interrupts);
  RenderResult result;
  {
    ProgressBar bar("rendering", "samples", 1.0, options.quiet);
    result = render(scene, built.accelerator, options.settings, bar.reporter(interrupts.token()));
  }
  for (const std::string& warning : result.warnings) console.warn(warning);
  console.say(fmt::format("picture    {} x {} pixels, {} sample{} each, {} rays in {}: {} Mrays/s", result.film.width(),
                          result.film.height(), options.settings.samples_per_pixel, options.settings.samples_per_pixel == 1 ? "" : "s",
                          with_separators(result.rays_traced), duration(result.seconds),
                          short_number(1e-6 * static_cast<double>(result.rays_traced) / result.seconds)));
  write_images(options, result, console);
  if (!options.json.empty()) write_figures(options, result, built.statistics, scene, spec);
  if (!result.interrupted) return 0;
  fmt::print(stderr, "grove render: interrupted; wrote what was finished, {:.1f} % of the samples\n", 100.0 * result.completed_fraction);
  return kInterrupted;
}

}  // namespace

Verb add_render(CLI::App& program) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App& verb = *program.add_subcommand("render", "Path-trace a scene to an image");
  RenderSettings& settings = options->settings;
  add_scene(verb, *options);
  verb.add_option("-o,--output", options->images, "Image to write, .exr (linear, with albedo and normal layers) or .png; may be repeated")
      ->required()
      ->type_name("IMAGE")
      ->allow_extra_args(false);
  add_structure(verb, *options);
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
  verb.add_option("--camera", settings.camera, "Name of a camera of the scene (default: its first, else a view of everything)")
      ->type_name("NAME");
  verb.add_option("--integrator", options->integrator, "What pixels show: path, ao, normal, depth or cost")
      ->type_name("NAME")
      ->capture_default_str();
  in_range(verb.add_option("--exposure", options->display.exposure, "Stops by which a path-traced .png is brightened")
               ->type_name("STOPS")
               ->capture_default_str(),
           -64.0, 64.0);
  add_json(verb, *options, "the figures");
  add_quiet(verb, *options);
  verb.footer(
      "Ctrl-C writes the picture with the samples that it has and exits with 130.\n\n"
      "Examples:\n"
      "  grove render builtin:cornell -o cornell.png\n"
      "  grove render scene.glb -o scene.exr -o scene.png --spp 256 --width 1920 --height 1080\n"
      "  grove render builtin:sphereflake -o cost.png --integrator cost --structure bvh --spp 4");
  return {&verb, [options](Interrupts& interrupts) { return with_threads(options->threads, [&] { return run(*options, interrupts); }); }};
}

}  // namespace grove::app
