// The grove command: finds the verb, runs it, and turns what goes wrong into one line and an exit code.

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "command_line.h"
#include "console.h"
#include "grove/base/error.h"
#include "verbs.h"

namespace grove::app {
namespace {

/// "grove" or "grove render", for messages.
std::string command_name(const CLI::App& program) {
  const auto verbs = program.get_subcommands();
  return verbs.empty() ? "grove" : "grove " + verbs.front()->get_name();
}

int fail(const std::string& command, const std::string& message, int exit_code) {
  std::fflush(stdout);
  std::string line = command + ": " + one_line(message);
  if (exit_code == kWrongCommand) line += fmt::format("; see '{} --help'", command);
  fmt::print(stderr, "{}\n", line);
  return exit_code;
}

std::string verb_list(const CLI::App& program) {
  std::string text;
  for (const CLI::App* verb : program.get_subcommands({})) {
    if (verb->get_group().empty()) continue;
    text += (text.empty() ? "" : ", ") + verb->get_name();
  }
  return text;
}

/// A word in the verb's place that is none gets the list; CLI11 would only call it unexpected.
bool is_unknown_verb(const CLI::App& program, const std::string& word) {
  const auto verbs = program.get_subcommands({});
  return !word.starts_with('-') && std::ranges::none_of(verbs, [&](const CLI::App* verb) { return verb->get_name() == word; });
}

/// An option before the verb that the program has not.
bool is_unknown_option(const CLI::App& program, const std::string& word) {
  return word.starts_with('-') && program.get_option_no_throw(word) == nullptr;
}

int run(int argument_count, char** arguments) {
  // Before anything can start a thread.
  keep_command_line(argument_count, arguments);
  Interrupts interrupts;

  CLI::App program("Grove: acceleration structures for ray tracing, built, traced, compared and rendered with.", "grove");
  program.set_version_flag("--version", "grove " GROVE_VERSION);
  program.require_subcommand(1);
  const std::array verbs{add_render(program),  add_merge(program),     add_trace(program),      add_compare(program),  add_inspect(program),
                         add_animate(program), add_reproduce(program), add_structures(program), add_try_build(program)};
  program.footer(
      "'grove VERB --help' tells all about a verb. Exit codes: 0 done, 1 the work failed, 2 the command was wrong, 130 interrupted.\n\n"
      "Examples:\n"
      "  grove render builtin:cornell -o cornell.png\n"
      "  grove compare builtin:sphereflake\n"
      "  grove structures");
  try {
    if (argument_count < 2) {
      throw UsageError("what to do is missing; the verbs are " + verb_list(program));
    }
    if (is_unknown_verb(program, arguments[1])) {
      throw UsageError(fmt::format("unknown verb '{}'; the verbs are {}", arguments[1], verb_list(program)));
    }
    if (is_unknown_option(program, arguments[1])) {
      throw UsageError(fmt::format("unknown option '{}'; options come after a verb: {}", arguments[1], verb_list(program)));
    }
    program.parse(argument_count, arguments);
    const auto chosen = std::ranges::find_if(verbs, [](const Verb& verb) { return verb.options->parsed(); });
    const int exit_code = chosen->run(interrupts);
    if (std::fflush(stdout) != 0) return fail(command_name(program), "standard output cannot be written", kWorkFailed);
    return exit_code;
  } catch (const CLI::Success& request) {
    // Help or version.
    return program.exit(request);
  } catch (const CLI::ParseError& error) {
    return fail(command_name(program), error.what(), kWrongCommand);
  } catch (const UsageError& error) {
    return fail(command_name(program), error.what(), kWrongCommand);
  } catch (const std::bad_alloc&) {
    return fail(command_name(program), "out of memory; try a smaller scene, image or number of rays", kWorkFailed);
  } catch (const std::exception& error) {
    return fail(command_name(program), error.what(), kWorkFailed);
  }
}

}  // namespace
}  // namespace grove::app

int main(int argument_count, char** arguments) {
  return grove::app::run(argument_count, arguments);
}
