#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "display_options.h"
#include "grove/base/error.h"
#include "grove/lab/text_table.h"
#include "grove/render/saved/merge_films.h"
#include "picture_files.h"
#include "reference_picture.h"
#include "session.h"
#include "verbs.h"

namespace grove::app {
namespace {

struct MergeOptions : CommonOptions {
  std::vector<std::filesystem::path> parts;
  std::vector<std::string> pictures;
  DisplayOptions display;
  ReferencePicture reference;
  bool allows_gaps = false;
};

int run(MergeOptions& options) {
  const Console console(options.quiet);
  check_pictures(options.pictures);
  parse_display(options.display);
  if (options.allows_gaps && has_film(options.pictures)) {
    throw UsageError("--partial: a .film is written of whole pictures only; write an .exr or .png, or leave --partial out");
  }
  // Before the films are read: the headers are quick to read, and all of one size or there is no picture.
  const FilmHeader first = read_film_header(options.parts.front());
  options.reference.read(first.width, first.height);
  console.status(fmt::format("merging {} films", options.parts.size()));
  MergedFilm merged = merge_films(options.parts);
  if (!merged.missing.empty()) {
    if (!options.allows_gaps) throw InputError("the picture is not complete: " + merged.missing + "; merge what there is with --partial");
    console.warn(merged.missing);
  }
  const FilmHeader& header = merged.whole.header;
  RenderResult result;
  result.film = std::move(merged.whole.film);
  result.integrator = integrator_from_name(fact_of(header.picture, "integrator"));
  result.part = header.part;
  result.interrupted = !header.is_finished;
  result.rays_traced = header.rays_traced;
  result.seconds = header.seconds;
  console.say(fmt::format("picture    {} x {} pixels, {} samples{}, from {} films; {} rays in {} of work", header.width, header.height,
                          header.samples_per_pixel, header.noise.is_on() ? " at most" : " each", options.parts.size(),
                          with_separators(header.rays_traced), duration(header.seconds)));
  write_pictures(options.pictures, result, {.display = options.display.settings}, header, console);
  options.reference.compare(result.colours(), options.display.settings, console);
  return 0;
}

}  // namespace

Verb add_merge(CLI::App& program) {
  const auto options = std::make_shared<MergeOptions>();
  CLI::App& verb = *program.add_subcommand("merge", "Put the parts of a picture together that 'grove render' made");
  verb.add_option("FILMS", options->parts, "Films, from 'grove render' with -o or --checkpoint")->required()->type_name("");
  verb.add_option("-o,--output", options->pictures, "Picture to write: .exr, .png, or .film; may be repeated")
      ->required()
      ->type_name("PICTURE")
      ->allow_extra_args(false);
  add_display(verb, options->display);
  options->reference.add_option(verb);
  verb.add_flag("--partial", options->allows_gaps, "Write the picture though parts of it are missing; they are black or have more noise");
  add_threads(verb, *options);
  add_quiet(verb, *options);
  verb.footer(
      "Merged tiles are, bit for bit, the picture that one render makes. Merged ranges of samples give the same picture in whatever order\n"
      "they are named.\n\n"
      "Examples:\n"
      "  grove render scene.glb -o a.film --tile 1/2\n"
      "  grove render scene.glb -o b.film --tile 2/2\n"
      "  grove merge a.film b.film -o scene.exr");
  return {&verb, [options](Interrupts& /*interrupts*/) { return with_threads(options->threads, [&] { return run(*options); }); }};
}

}  // namespace grove::app
