#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "command_line.h"
#include "grove/base/error.h"
#include "grove/base/output_file.h"
#include "grove/lab/claims/reproduce_report.h"
#include "grove/lab/text_table.h"
#include "html_file.h"
#include "session.h"
#include "verbs.h"

namespace grove::app {
namespace {

struct ReproduceOptions : CommonOptions {
  ReproduceSettings settings;
  std::string only;
  std::filesystem::path markdown;
  bool lists = false;
  bool restarts = false;
};

int list_claims() {
  TextTable table({{"claim"}, {"section"}, {"what the review says"}});
  for (const Claim& claim : review_claims())
    table.add_row({std::string(claim.id), std::string(claim.source), std::string(claim.statement)});
  fmt::print("{}", table.text());
  return 0;
}

/// Empty where there is no such file.
std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What an earlier run left in the file, as far as this one can go on from it.
Reproduction read_earlier(const ReproduceOptions& options, const Console& console) {
  if (options.restarts) return {};
  std::ifstream file(options.json);
  if (!file) return {};
  const nlohmann::ordered_json json = nlohmann::ordered_json::parse(file, nullptr, false);
  Reproduction earlier = reproduction_from_json(json, options.json.string());
  if (!can_resume(earlier, options.settings)) {
    console.say(fmt::format("{} is from another machine, commit or effort: every claim is checked anew", options.json.string()));
    return {};
  }
  if (!earlier.claims.empty())
    console.say(fmt::format("{} has {} claims of the same machine and commit; only the others are checked", options.json.string(),
                            earlier.claims.size()));
  return earlier;
}

int run(ReproduceOptions& options, Interrupts& interrupts) {
  if (options.lists) return list_claims();
  const Console console(options.quiet);
  if (!options.only.empty()) options.settings.only = split_list("--only", options.only, ',');
  if (options.json.empty()) options.json = options.settings.quick ? "reproduce-quick.json" : "reproduce.json";
  check_writable(options.json);
  if (!options.markdown.empty()) check_writable(options.markdown);
  check_html(options, PageKind::report);
  const Reproduction earlier = read_earlier(options, console);
  options.settings.command = command_line();

  const ReproduceObserver observer{[&](const Claim& claim, std::size_t number, std::size_t total) {
                                     console.status(fmt::format("{} of {}: {}", number, total, claim.id));
                                   },
                                   [&](const Reproduction& so_far) {
                                     write_text_file(options.json, reproduction_json(so_far).dump(1) + "\n");
                                     console.clear_status();
                                     fmt::print("{}\n", claim_text(so_far.claims.back()));
                                     std::fflush(stdout);
                                   }};
  // The first signal stops the experiment under way; what is finished is kept.
  const Interrupts::Graceful graceful(interrupts);
  const Reproduction reproduction = reproduce(options.settings, earlier, observer, interrupts.token());
  console.clear_status();
  fmt::print("{}\n", tally_text(reproduction));
  if (!options.markdown.empty()) {
    const std::string earlier_text = read_text(options.markdown);
    write_text_file(options.markdown, replace_generated(earlier_text, reproduction_markdown(reproduction)));
  }
  write_html(options, PageKind::report, "The review's claims, measured", reproduction_json(reproduction));
  console.say(fmt::format("results are in {}", options.json.string()));
  const auto failed = std::ranges::count_if(reproduction.claims, [](const CheckedClaim& claim) { return !claim.finding; });
  std::fflush(stdout);
  if (failed > 0) {
    fmt::print(stderr, "grove reproduce: {} of {} claims could not be checked; the list says why\n", failed, reproduction.claims.size());
    return kWorkFailed;
  }
  if (reproduction.is_complete) return 0;
  fmt::print(stderr, "grove reproduce: interrupted; the same command goes on after the claims that are finished\n");
  return kInterrupted;
}

}  // namespace

Verb add_reproduce(CLI::App& program) {
  const auto options = std::make_shared<ReproduceOptions>();
  CLI::App& verb = *program.add_subcommand("reproduce", "Check what the review of data structures claims, each claim by an experiment");
  verb.add_flag("--quick", options->settings.quick, "Small scenes: three minutes on two cores in place of half an hour");
  verb.add_option("--only", options->only, "Check these claims alone (default: all)")->type_name("CLAIM,CLAIM");
  verb.add_flag("--list", options->lists, "List the claims and check none");
  verb.add_flag("--restart", options->restarts, "Do not go on from an earlier run's results");
  add_threads(verb, *options);
  add_json(verb, *options,
           "claims, verdicts and figures; an interrupted run goes on from it (default: reproduce.json, with --quick reproduce-quick.json)");
  verb.add_option("--markdown", options->markdown,
                  "Write the findings to this file as a document; what is written by hand outside of its marks stays")
      ->type_name("FILE");
  add_html(verb, *options, "claims, verdicts and figures");
  add_quiet(verb, *options);
  verb.footer(
      "Each claim is held against counts and times on generated scenes; structures take turns, round by round, and all hits are compared. "
      "Results are saved\n"
      "after each claim, so an interrupted run loses at most one.\n\n"
      "Examples:\n"
      "  grove reproduce --quick\n"
      "  grove reproduce --only octree-r-gain,octree-r-candidates\n"
      "  grove reproduce --markdown findings.md --html findings.html");
  return {&verb, [options](Interrupts& interrupts) { return with_threads(options->threads, [&] { return run(*options, interrupts); }); }};
}

}  // namespace grove::app
