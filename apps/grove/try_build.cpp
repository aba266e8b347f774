#include <fmt/format.h>
#include <unistd.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <iostream>
#include <memory>
#include <string>

#include "grove/base/error.h"
#include "grove/scene/load.h"
#include "session.h"
#include "verbs.h"

namespace grove::app {
namespace {

void answer(std::string_view line) {
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

/// Keeps the structure until it has been looked at from outside.
void build_one(const Scene& scene, const std::string& spec) {
  try {
    const SceneAccelerator accelerator(scene, spec);
    answer("built");
  } catch (const std::exception& exception) {
    answer("failed " + one_line(reason_of(exception)));
  }
#ifdef __GLIBC__
  // What the next build takes is counted from here.
  malloc_trim(0);
#endif
  answer("ready");
}

int run(const CommonOptions& options) {
  Scene scene = load_scene(options.scene);
  drop_shading_data(scene);
  answer("ready");
  std::string spec;
  while (std::getline(std::cin, spec)) build_one(scene, spec);
  return 0;
}

}  // namespace

Verb add_try_build(CLI::App& program) {
  const auto options = std::make_shared<CommonOptions>();
  CLI::App& verb = *program.add_subcommand("try-build", "Build structures named on standard input, for a parent that watches");
  verb.group("");
  add_scene(verb, *options);
  add_threads(verb, *options);
  return {&verb, [options](Interrupts& /*interrupts*/) { return with_threads(options->threads, [&] { return run(*options); }); }};
}

}  // namespace grove::app
