#include <fmt/format.h>

#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "grove/base/error.h"
#include "grove/base/output_file.h"
#include "grove/lab/animation_report.h"
#include "grove/lab/text_table.h"
#include "progress_bar.h"
#include "session.h"
#include "verbs.h"

namespace grove::app {
namespace {

constexpr std::uint64_t kMostFrames = 100'000;
constexpr std::uint64_t kMostRays = 100'000'000;

struct AnimateOptions : CommonOptions {
  std::string policies;
  std::string rays;
  std::filesystem::path csv;
  AnimationSettings settings;
};

int run(AnimateOptions& options, Interrupts& interrupts) {
  const Console console(options.quiet);
  options.settings.structure = canonical_spec(options.structure);
  if (!options.rays.empty()) options.settings.rays = parse_ray_kind(options.rays);
  if (!options.policies.empty()) {
    options.settings.policies.clear();
    for (const std::string& name : split_list("--update", options.policies, ','))
      options.settings.policies.push_back(parse_update_policy(name));
  }
  if (!options.json.empty()) check_writable(options.json);
  if (!options.csv.empty()) check_writable(options.csv);
  const MovingScene scene = moving_scene(options.scene);

  Animation animation;
  {
    ProgressBar bar("playing", "frames", 1.0, options.quiet);
    animation = animate(scene, options.settings, bar.reporter(interrupts.token()));
  }
  // What is being written is finished first; a second signal ends it.
  const Interrupts::Graceful graceful(interrupts);
  animation.scene = options.scene;
  console.say(fmt::format("{}: {} triangles, {} frames, {} {} rays a frame with {}\n", options.scene, with_separators(animation.primitives),
                          options.settings.frames, with_separators(animation.ray_count), name_of(animation.rays), animation.structure));
  fmt::print("{}", animation_table(animation));
  if (!options.json.empty()) write_text_file(options.json, animation_json(animation).dump(2) + "\n");
  if (!options.csv.empty()) write_text_file(options.csv, animation_csv(animation));
  std::uint64_t mismatches = 0;
  for (const AnimationRow& row : animation.rows) mismatches += row.mismatches;
  if (mismatches == 0) return 0;
  std::fflush(stdout);
  fmt::print(stderr, "grove animate: {} hits are not those of a structure built anew\n", mismatches);
  return kWorkFailed;
}

}  // namespace

Verb add_animate(CLI::App& program) {
  const auto options = std::make_shared<AnimateOptions>();
  CLI::App& verb = *program.add_subcommand("animate", "Play a moving scene and compare ways of keeping a structure up to date");
  AnimationSettings& settings = options->settings;
  add_scene(verb, *options);
  add_structure(verb, *options);
  verb.add_option("--update", options->policies, "Ways to update, side by side: auto, refit, rotate, rebuild (default: all)")
      ->type_name("WAY,WAY");
  in_range(verb.add_option("--frames", settings.frames, "Frames from time 0 to 1")->type_name("N")->capture_default_str(), std::uint64_t{1},
           kMostFrames);
  verb.add_option("--rays", options->rays, "Kind of rays: primary, diffuse, shadow or random (default: diffuse)")->type_name("KIND");
  in_range(verb.add_option("--count", settings.workload.ray_count, "Rays a frame; auto rebuilds the sooner the more there are")
               ->type_name("N")
               ->capture_default_str(),
           std::uint64_t{1}, kMostRays);
  in_range(verb.add_option("--seed", settings.workload.seed, "Another seed, other rays")->type_name("S")->capture_default_str(),
           std::uint64_t{0}, std::numeric_limits<std::uint64_t>::max());
  add_threads(verb, *options);
  add_json(verb, *options, "a row for each frame and way");
  verb.add_option("--csv", options->csv, "Write the rows to this file as comma-separated values")->type_name("FILE");
  add_quiet(verb, *options);
  verb.footer(
      "Every hit is checked against a structure built anew in each frame. Figures are medians over the frames, with the least and the "
      "most.\n\n"
      "Examples:\n"
      "  grove animate builtin:twist\n"
      "  grove animate \"builtin:shatter?size=200\" --update auto,rebuild --frames 50 --csv shatter.csv\n"
      "  grove animate builtin:twist --structure bvh:arity=8 --rays random --count 1000000");
  return {&verb, [options](Interrupts& interrupts) { return with_threads(options->threads, [&] { return run(*options, interrupts); }); }};
}

}  // namespace grove::app
