#include <fmt/format.h>

#include <charconv>
#include <memory>
#include <nlohmann/json.hpp>

#include "grove/base/error.h"
#include "grove/base/output_file.h"
#include "grove/lab/clustering.h"
#include "grove/lab/node_boxes.h"
#include "grove/lab/split_costs.h"
#include "grove/lab/structure_report.h"
#include "grove/lab/text_table.h"
#include "session.h"
#include "verbs.h"

namespace grove::app {
namespace {

constexpr unsigned kSplitPlanes = 255;

struct InspectOptions : CommonOptions {
  std::filesystem::path obj;
  std::filesystem::path split_costs;
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

int run(const InspectOptions& options, Interrupts& interrupts) {
  const Console console(options.quiet);
  const std::string spec = canonical_spec(options.structure);
  const DepthRange depths = parse_depths(options.depths);
  if (!options.json.empty()) check_writable(options.json);
  if (!options.obj.empty()) check_writable(options.obj);
  if (!options.split_costs.empty()) check_writable(options.split_costs);
  Scene scene = load(options.scene, console);
  drop_shading_data(scene);
  const BuiltStructure built = build_structure(scene, spec, console);
  console.status("measuring quality");
  const StructureQuality quality = built.accelerator.measure_quality();
  const std::optional<double> clustering = clustering_of(scene);

  // What is being written is finished first; a second signal ends it.
  const Interrupts::Graceful graceful(interrupts);
  console.say("");
  fmt::print("{}", structure_text(spec, built.statistics, quality, clustering, arena_threads()));
  if (!options.json.empty()) {
    nlohmann::ordered_json json = structure_json(spec, built.statistics, arena_threads());
    json.update(quality_json(quality));
    json["clustering"] = nullptr;
    if (clustering) json["clustering"] = *clustering;
    json["scene"] = options.scene;
    write_text_file(options.json, json.dump(2) + "\n");
  }
  if (!options.obj.empty()) {
    const std::uint64_t box_count = write_node_boxes(options.obj, built.accelerator.top(), depths);
    console.say(fmt::format("\nwrote {}: {} boxes", options.obj.string(), with_separators(box_count)));
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
  add_quiet(verb, *options);
  verb.footer(
      "Examples:\n"
      "  grove inspect builtin:mount\n"
      "  grove inspect scene.glb --structure bvh:leaf-size=4 --json inspect.json\n"
      "  grove inspect builtin:rings --obj boxes.obj --depth 0-6");
  return {&verb, [options](Interrupts& interrupts) { return with_threads(options->threads, [&] { return run(*options, interrupts); }); }};
}

}  // namespace grove::app
