#include <fmt/format.h>

#include <charconv>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "grove/base/error.h"
#include "grove/base/output_file.h"
#include "grove/lab/clustering.h"
#include "grove/lab/node_boxes.h"
#include "grove/lab/page.h"
#include "grove/lab/split_costs.h"
#include "grove/lab/structure_report.h"
#include "grove/lab/text_table.h"
#include "grove/lab/view/structure_view.h"
#include "grove/lab/workload.h"
#include "session.h"
#include "verbs.h"

namespace grove::app {
namespace {

constexpr unsigned kSplitPlanes = 255;
// More have no room beside each other.
constexpr std::size_t kMostStructures = 6;

struct InspectOptions : CommonOptions {
  std::filesystem::path obj;
  std::filesystem::path split_costs;
  std::filesystem::path html;
  std::string camera;
  std::string depths;
};

/// "3" or "2-5".
DepthRange parse_depths(const std::string& text) {
  if (text.empty()) return {};
  DepthRange range;
  const char* const end = text.data() + text.size();
  auto parsed = std::from_chars(text.data(), end, range.first);
  range.last = range.first;
  if (parsed.ec == std::errc() && parsed.ptr != end && *parsed.ptr == '-') parsed = std::from_chars(parsed.ptr + 1, end, range.last);
  if (parsed.ec != std::errc() || parsed.ptr != end || range.first > range.last) {
    throw UsageError("--depth: '" + text + "' is not a depth such as 3 or a range such as 2-5");
  }
  return range;
}

std::string command_of(const InspectOptions& options) {
  std::string command = fmt::format("grove inspect {} --structure \"{}\"", options.scene, options.structure);
  if (!options.camera.empty()) command += fmt::format(" --camera {}", options.camera);
  return command + " --html " + options.html.string();
}

/// The canonical specs of --structure.
std::vector<std::string> parse_structures(const InspectOptions& options) {
  const bool has_several = options.structure.find(';') != std::string::npos;
  std::vector<std::string> specs = has_several ? split_list("--structure", options.structure, ';') : std::vector{options.structure};
  for (std::string& spec : specs) {
    spec = canonical_spec(spec);
    // Known before anything is built.
    if (!options.html.empty() && spec == "brute") throw UsageError("--html: structure 'brute' has no nodes to show; name another");
  }
  if (!has_several) return specs;
  if (specs.size() > kMostStructures)
    throw UsageError(fmt::format("--structure: {} structures are too many for one page; name at most {}", specs.size(), kMostStructures));
  for (const auto& [file, option] : {std::pair(&options.json, "--json"), std::pair(&options.obj, "--obj")}) {
    if (!file->empty()) throw UsageError(fmt::format("--structure: {} is of one structure; name one", option));
  }
  if (options.html.empty()) throw UsageError("--structure: several structures are shown side by side by --html FILE; give it, or name one");
  return specs;
}

void check_outputs(const InspectOptions& options) {
  if (!options.html.empty()) check_page_available(PageKind::structure);
  for (const std::filesystem::path* const path : {&options.json, &options.obj, &options.split_costs, &options.html})
    if (!path->empty()) check_writable(*path);
}

/// Writes what is of one structure alone.
void write_files(const InspectOptions& options, const DepthRange& depths, const BuiltStructure& built,
                 const nlohmann::ordered_json& figures, const Console& console) {
  if (!options.json.empty()) {
    nlohmann::ordered_json json = figures;
    json["scene"] = options.scene;
    write_text_file(options.json, json.dump(2) + "\n");
  }
  if (!options.obj.empty()) {
    const std::uint64_t box_count = write_node_boxes(options.obj, built.accelerator.top(), depths);
    console.say(fmt::format("\nwrote {}: {} boxes", options.obj.string(), with_separators(box_count)));
  }
}

int run(const InspectOptions& options, Interrupts& interrupts) {
  const Console console(options.quiet);
  const std::vector<std::string> specs = parse_structures(options);
  const DepthRange depths = parse_depths(options.depths);
  check_outputs(options);
  Scene scene = load(options.scene, console);
  drop_shading_data(scene);
  const Camera camera = workload_camera(scene, options.camera);
  std::optional<StructureView> view;
  if (!options.html.empty()) view.emplace(scene, camera, specs.size());
  const std::optional<double> clustering = clustering_of(scene);

  for (const std::string& spec : specs) {
    const BuiltStructure built = build_structure(scene, spec, console);
    console.status("measuring quality");
    const StructureQuality quality = built.accelerator.measure_quality();
    nlohmann::ordered_json figures = structure_json(spec, built.statistics, arena_threads());
    figures.update(quality_json(quality));
    figures["clustering"] = nullptr;
    if (clustering) figures["clustering"] = *clustering;
    if (view) {
      console.status("tracing rays");
      view->add(built.accelerator, figures);
    }
    // What is being written is finished first; a second signal ends it.
    const Interrupts::Graceful graceful(interrupts);
    console.say("");
    fmt::print("{}", structure_text(spec, built.statistics, quality, clustering, arena_threads()));
    write_files(options, depths, built, figures, console);
  }
  const Interrupts::Graceful graceful(interrupts);
  if (view) {
    const std::string page =
        html_page(PageKind::structure, "Structures over " + options.scene, view->json(options.scene, command_of(options)));
    write_text_file(options.html, page);
    console.say(fmt::format("\nwrote {}: {}", options.html.string(), byte_size(page.size())));
  }
  if (!options.split_costs.empty()) {
    write_text_file(options.split_costs, split_costs_csv(split_cost_curves(scene, kSplitPlanes)));
    console.say(fmt::format("\nwrote {}: costs of {} planes an axis", options.split_costs.string(), kSplitPlanes));
  }
  return 0;
}

}  // namespace

Verb add_inspect(CLI::App& program) {
  const auto options = std::make_shared<InspectOptions>();
  CLI::App& verb = *program.add_subcommand("inspect", "Show what a structure is made of");
  add_scene(verb, *options);
  add_structure(verb, *options);
  add_threads(verb, *options);
  add_json(verb, *options, "the figures");
  verb.add_option("--obj", options->obj, "Write the boxes of the nodes (of the top level) to this file as Wavefront OBJ lines")
      ->type_name("FILE");
  verb.add_option("--depth", options->depths, "Levels whose boxes --obj writes: one, or a range; the root is 0 (default: all)")
      ->type_name("N|N-N");
  verb.add_option("--split-costs", options->split_costs,
                  "Write the cost of parting the largest object at planes along each axis, today's form and equation 2, to this CSV file")
      ->type_name("FILE");
  verb.add_option(
          "--html", options->html,
          "Write a page that shows the structure, or several parted by ';' side by side, in three dimensions, and steps rays through it")
      ->type_name("FILE");
  verb.add_option("--camera", options->camera,
                  "The camera of the scene whose rays --html traces (default: the first, or a view of everything)")
      ->type_name("NAME");
  add_quiet(verb, *options);
  verb.footer(
      "Examples:\n"
      "  grove inspect builtin:mount\n"
      "  grove inspect scene.glb --structure bvh:leaf-size=4 --json inspect.json\n"
      "  grove inspect builtin:rings --obj boxes.obj --depth 0-6\n"
      "  grove inspect builtin:rings --structure \"bvh;kdtree;octree:walk=neighbour\" --html structures.html");
  return {&verb, [options](Interrupts& interrupts) { return with_threads(options->threads, [&] { return run(*options, interrupts); }); }};
}

}  // namespace grove::app
