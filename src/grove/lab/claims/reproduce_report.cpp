#include "grove/lab/claims/reproduce_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "grove/base/error.h"
#include "grove/lab/comparison_report.h"
#include "grove/lab/text_table.h"

namespace grove {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kVersion = 1;
constexpr std::string_view kFormat = "grove-reproduce";
constexpr std::string_view kGeneratedBegins = "<!-- grove reproduce writes from here -->\n";
constexpr std::string_view kGeneratedEnds = "<!-- to here -->\n";

Json claim_json(const CheckedClaim& claim) {
  Json sections = Json::array();
  for (const ReportSection& section : claim.finding->sections) sections.push_back(section_json(section));
  Json json{{"id", claim.id},           {"statement", claim.statement},        {"source", claim.source},
            {"method", claim.method},   {"measured", claim.finding->measured}, {"verdict", name_of(claim.finding->verdict)},
            {"seconds", claim.seconds}, {"sections", std::move(sections)}};
  if (!claim.finding->why.empty()) json["why"] = claim.finding->why;
  return json;
}

Verdict verdict_from(const std::string& name) {
  for (const Verdict verdict : {Verdict::holds, Verdict::fails, Verdict::mixed}) {
    if (name_of(verdict) == name) return verdict;
  }
  throw InputError("'" + name + "' is no verdict");
}

CheckedClaim claim_from_json(const Json& json) {
  CheckedClaim claim{json.at("id"), json.at("statement"), json.at("source"), json.at("method"), Finding(), "", json.at("seconds")};
  claim.finding->verdict = verdict_from(json.at("verdict"));
  claim.finding->measured = json.at("measured");
  claim.finding->why = json.value("why", "");
  for (const Json& section : json.at("sections")) claim.finding->sections.push_back(section_from_json(section));
  return claim;
}

Machine machine_from_json(const Json& json) {
  return {json.at("cpu"), json.at("cores"), json.at("threads"), json.at("compiler"), json.value("commit", ""), json.at("os")};
}

/// Breaks a text into lines of at most `width` characters, each after `indent` spaces.
std::string wrap(const std::string& text, std::size_t width, std::size_t indent) {
  std::string result;
  std::size_t column = width;
  std::size_t start = 0;
  while (start < text.size()) {
    const std::size_t end = std::min(text.find(' ', start), text.size());
    const std::string word = text.substr(start, end - start);
    if (column + 1 + word.size() > width) {
      result += (result.empty() ? "" : "\n") + std::string(indent, ' ') + word;
      column = indent + word.size();
    } else {
      result += ' ' + word;
      column += 1 + word.size();
    }
    start = end + 1;
  }
  return result;
}

std::size_t count_of(const Reproduction& reproduction, Verdict verdict) {
  return static_cast<std::size_t>(std::ranges::count_if(
      reproduction.claims, [&](const CheckedClaim& claim) { return claim.finding && claim.finding->verdict == verdict; }));
}

/// The review's sections that have claims.
constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kSections{{{"III.A", "Octrees"},
                                                                                  {"III.B", "Kd-trees"},
                                                                                  {"III.C", "Bounding volume hierarchies"},
                                                                                  {"IV.A", "Parallel construction"},
                                                                                  {"IV.B", "Octree-R and the cost models"}}};

/// A text in one paragraph of Markdown, in which nothing is markup.
std::string plain(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '*' || c == '_' || c == '<' || c == '|' ? std::string("\\") + c : std::string(1, c);
  return result;
}

/// A list of what was found of the claims that are chosen.
template <typename Choice>
std::string conclusions_of(const Reproduction& reproduction, const Choice& is_chosen) {
  std::string items;
  for (const CheckedClaim& claim : reproduction.claims) {
    if (!claim.finding || !is_chosen(claim)) continue;
    items += fmt::format("- **{}** ({}) {}{}{} [figures](#{})\n", plain(claim.statement), name_of(claim.finding->verdict),
                         plain(claim.finding->measured), claim.finding->why.empty() ? "" : " ", plain(claim.finding->why), claim.id);
  }
  return items;
}

std::string conclusions(const Reproduction& reproduction) {
  std::string text;
  for (const auto& section : kSections) {
    const std::string items =
        conclusions_of(reproduction, [&](const CheckedClaim& claim) { return claim.source.starts_with(section.first); });
    if (!items.empty()) text += fmt::format("### {}: {}\n\n{}\n", section.first, section.second, items);
  }
  const std::string others = conclusions_of(reproduction, [](const CheckedClaim& claim) {
    return std::ranges::none_of(kSections, [&](const auto& section) { return claim.source.starts_with(section.first); });
  });
  if (!others.empty()) text += "### Beyond the review\n\n" + others + "\n";
  return text;
}

}  // namespace

Json reproduction_json(const Reproduction& reproduction) {
  Json claims = Json::array();
  Json failed = Json::array();
  for (const CheckedClaim& claim : reproduction.claims) {
    if (claim.finding) {
      claims.push_back(claim_json(claim));
    } else {
      failed.push_back({{"id", claim.id}, {"error", claim.error}});
    }
  }
  Json json{{"format", kFormat},
            {"version", kVersion},
            {"machine", machine_json(reproduction.machine)},
            {"command", reproduction.command},
            {"date", reproduction.date},
            {"quick", reproduction.quick},
            {"seconds", reproduction.seconds},
            {"complete", reproduction.is_complete},
            {"claims", std::move(claims)}};
  if (!failed.empty()) json["failed"] = std::move(failed);
  return json;
}

Reproduction reproduction_from_json(const Json& json, const std::string& file) {
  try {
    if (json.at("format") != kFormat || json.at("version") != kVersion)
      throw InputError(file, "", "no results of grove reproduce; name another file");
    Reproduction reproduction{machine_from_json(json.at("machine")),
                              json.at("quick"),
                              json.at("command"),
                              json.at("date"),
                              json.at("seconds"),
                              json.at("complete"),
                              {}};
    for (const Json& claim : json.at("claims")) reproduction.claims.push_back(claim_from_json(claim));
    return reproduction;
  } catch (const nlohmann::json::exception&) {
    throw InputError(file, "", "no results of grove reproduce; name another file, or delete this one");
  }
}

std::string tally_text(const Reproduction& reproduction) {
  const auto failed =
      static_cast<std::size_t>(std::ranges::count_if(reproduction.claims, [](const CheckedClaim& claim) { return !claim.finding; }));
  const auto number = [](std::size_t count, const char* one, const char* others) {
    return fmt::format("{} {}", count, count == 1 ? one : others);
  };
  std::string text = fmt::format("{}: {}, {}, {}", number(reproduction.claims.size(), "claim", "claims"),
                                 number(count_of(reproduction, Verdict::holds), "holds", "hold"),
                                 number(count_of(reproduction, Verdict::mixed), "is mixed", "are mixed"),
                                 number(count_of(reproduction, Verdict::fails), "fails", "fail"));
  if (failed > 0) text += fmt::format("; {} could not be checked", failed);
  return text;
}

std::string claim_text(const CheckedClaim& claim) {
  constexpr std::size_t kWidth = 120;
  constexpr std::size_t kIndent = 8;
  const std::string verdict = claim.finding ? std::string(name_of(claim.finding->verdict)) : "failed";
  return fmt::format("{:<8}{} ({}, {})\n{}\n{}\n", verdict, claim.id, claim.source, duration(claim.seconds),
                     wrap(claim.statement, kWidth, kIndent),
                     wrap(claim.finding ? "→ " + claim.finding->measured : "→ " + claim.error, kWidth, kIndent)) +
         (claim.finding && !claim.finding->why.empty() ? wrap("Why: " + claim.finding->why, kWidth, kIndent) + "\n" : "");
}

std::string reproduction_markdown(const Reproduction& reproduction) {
  std::string text = fmt::format(
      "# The review's claims, measured\n\n{}\nWritten by `{}` on {}: {}, {} threads, {}{}. The {}experiments took {}.\n\n{}.\n\n"
      "`holds`: true as stated in all cases that were measured; `fails`: in none; `mixed`: in some, or in part. What counts is said with "
      "each experiment.\n\n",
      kGeneratedBegins, reproduction.command, reproduction.date.substr(0, 10), reproduction.machine.cpu, reproduction.machine.threads,
      reproduction.machine.compiler, reproduction.machine.commit.empty() ? "" : ", commit " + reproduction.machine.commit.substr(0, 12),
      reproduction.quick ? "quick " : "", duration(reproduction.seconds), tally_text(reproduction));
  text += "## What the review says, and what was found\n\n" + conclusions(reproduction) + "## The experiments\n\n";
  for (const CheckedClaim& claim : reproduction.claims) {
    text += fmt::format("### {}\n\n", claim.id);
    if (!claim.finding) {
      text += fmt::format("Could not be checked: {}\n\n", plain(claim.error));
      continue;
    }
    text += fmt::format("{} ({})\n\n{}\n\n**{}**: {}\n\n", plain(claim.statement), claim.source, plain(claim.method),
                        name_of(claim.finding->verdict), plain(claim.finding->measured));
    if (!claim.finding->why.empty()) text += plain(claim.finding->why) + "\n\n";
    for (const ReportSection& section : claim.finding->sections) {
      // A plot alone repeats what is in a table above it.
      if (section.table) text += section_markdown(section, 4);
    }
  }
  return text + std::string(kGeneratedEnds);
}

std::string replace_generated(std::string_view document, const std::string& generated) {
  const std::size_t begin = document.find(kGeneratedBegins);
  const std::size_t end = document.find(kGeneratedEnds, begin == std::string_view::npos ? 0 : begin);
  if (begin == std::string_view::npos || end == std::string_view::npos) return generated;
  return std::string(document.substr(0, begin)) + generated.substr(generated.find(kGeneratedBegins)) +
         std::string(document.substr(end + kGeneratedEnds.size()));
}

}  // namespace grove
