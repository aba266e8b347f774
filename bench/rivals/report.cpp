#include "rivals/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "grove/lab/text_table.h"

namespace grove::bench::rivals {
namespace {

const std::array<RivalGroup, 6> kGroups = {{{"single", 1, false},
                                            {"single robust", 1, true},
                                            {"packets of 8", 8, false},
                                            {"packets of 8 robust", 8, true},
                                            {"packets of 16", 16, false},
                                            {"packets of 16 robust", 16, true}}};

std::string text(const Spread& spread) {
  return fmt::format("{:.2f} ({:.2f}-{:.2f})", spread.median, spread.min, spread.max);
}

nlohmann::ordered_json json(const Spread& spread) {
  return {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}};
}

bool is_in(const WayRate& rate, const RivalGroup& group) {
  return rate.way.contender.is_rival && rate.way.contender.is_robust == group.is_robust && rate.way.call_size == group.call_size;
}

// Of the group's ways with these rays and threads, the one with the highest median; null when none was timed.
const WayRate* quickest(const SceneResult& result, const RivalGroup& group, const WayRate& beside) {
  const WayRate* best = nullptr;
  for (const WayRate& rate : result.rates) {
    if (!is_in(rate, group) || rate.way.kind != beside.way.kind || rate.threads != beside.threads) continue;
    if (best == nullptr || spread_of(rate.mrays_per_s).median > spread_of(best->mrays_per_s).median) best = &rate;
  }
  return best;
}

std::string way_name(const std::string& structure, std::size_t call_size) {
  return call_size == 1 ? structure + ", single" : fmt::format("{}, {} a call", structure, call_size);
}

}  // namespace

std::span<const RivalGroup> rival_groups() {
  return kGroups;
}

std::vector<Ratio> ratios_of(const SceneResult& result) {
  std::vector<Ratio> ratios;
  for (const WayRate& rate : result.rates) {
    if (rate.way.contender.is_rival) continue;
    for (const RivalGroup& group : kGroups) {
      const WayRate* const rival = quickest(result, group, rate);
      if (rival == nullptr) continue;
      std::vector<double> by_round;
      by_round.reserve(rate.mrays_per_s.size());
      for (std::size_t round = 0; round < rate.mrays_per_s.size(); ++round)
        by_round.push_back(rate.mrays_per_s[round] / rival->mrays_per_s[round]);
      ratios.push_back({rate.way.call_size, rate.way.contender.name, rate.way.kind, rate.threads, group.name,
                        way_name(rival->way.contender.name, rival->way.call_size), spread_of(by_round)});
    }
  }
  return ratios;
}

namespace {

// A table whose last columns are the kinds of rays.
class KindTable {
 public:
  explicit KindTable(const std::vector<std::string>& headings) : table_(columns(headings)) {}

  void add(std::vector<std::string> row, const std::map<RayKind, std::string>& cells) {
    row.reserve(row.size() + ray_kinds().size());
    for (const RayKind kind : ray_kinds()) {
      const auto cell = cells.find(kind);
      row.push_back(cell == cells.end() ? "-" : cell->second);
    }
    table_.add_row(std::move(row));
  }
  [[nodiscard]] std::string text() const { return table_.text() + "\n"; }

 private:
  static std::vector<TextTable::Column> columns(const std::vector<std::string>& headings) {
    std::vector<TextTable::Column> all;
    all.reserve(headings.size() + ray_kinds().size());
    for (const std::string& heading : headings)
      all.push_back({heading, heading == "threads" ? TextTable::Align::right : TextTable::Align::left});
    for (const RayKind kind : ray_kinds()) all.push_back({std::string(name_of(kind)), TextTable::Align::right});
    return all;
  }

  TextTable table_;
};

// What a row of ratios is of: structure, rays a call, group, threads.
using RatioRow = std::tuple<std::string, std::size_t, std::string, int>;

RatioRow row_of(const Ratio& one) {
  return {one.structure, one.call_size, one.group, one.threads};
}

std::vector<std::string> cells_of(const RatioRow& row) {
  const auto& [structure, call_size, group, threads] = row;
  return {way_name(structure, call_size), group, std::to_string(threads)};
}

std::string build_table(const SceneResult& result) {
  TextTable table({{"build"},
                   {"threads", TextTable::Align::right},
                   {"seconds", TextTable::Align::right},
                   {"bytes a triangle", TextTable::Align::right}});
  for (const BuildTime& build : result.builds) {
    const Spread seconds = spread_of(build.seconds);
    table.add_row({build.contender.name, std::to_string(build.threads),
                   fmt::format("{:.3f} ({:.3f}-{:.3f})", seconds.median, seconds.min, seconds.max),
                   fmt::format("{:.1f}", build.bytes_per_triangle)});
  }
  return table.text() + "\n";
}

// Of all ways that differ anywhere: in how many rays, and how many of those are no matter of rounding.
std::string disagreement_table(const SceneResult& result) {
  std::map<std::pair<std::string, std::size_t>, std::map<RayKind, std::string>> rows;
  std::size_t rays = 0;
  for (const WayAgreement& one : result.agreements) {
    rays = one.rays;
    if (one.differing == 0) continue;
    std::string& cell = rows[{one.way.contender.name, one.way.call_size}][one.way.kind];
    cell = std::to_string(one.differing);
    if (one.unexplained > 0) cell += fmt::format(", {} unexplained", one.unexplained);
    if (!one.is_good) cell += ": not timed";
  }
  if (rows.empty()) return fmt::format("all hits agree, {} rays of each kind\n\n", with_separators(rays));
  KindTable table({fmt::format("rays of {} that differ from fast", with_separators(rays))});
  for (const auto& [way, cells] : rows) table.add({way_name(way.first, way.second)}, cells);
  return table.text();
}

std::string rate_table(const SceneResult& result) {
  std::map<std::tuple<int, std::size_t>, std::map<RayKind, std::string>> rows;  // in the order in which ways were first timed
  std::map<std::pair<std::string, std::size_t>, std::size_t> places;
  std::vector<std::string> names;
  for (const WayRate& rate : result.rates) {
    const auto [place, is_new] = places.try_emplace({rate.way.contender.name, rate.way.call_size}, names.size());
    if (is_new) names.push_back(way_name(rate.way.contender.name, rate.way.call_size));
    rows[{rate.threads, place->second}][rate.way.kind] = text(spread_of(rate.mrays_per_s));
  }
  KindTable table({"Mrays/s", "threads"});
  for (const auto& [row, cells] : rows) table.add({names[std::get<1>(row)], std::to_string(std::get<0>(row))}, cells);
  return table.text();
}

std::string ratio_table(const SceneResult& result) {
  std::map<RatioRow, std::map<RayKind, std::string>> rows;
  for (const Ratio& one : ratios_of(result)) rows[row_of(one)][one.kind] = text(one.ratio);
  KindTable table({"ratio", "beside Embree's quickest", "threads"});
  for (const auto& [row, cells] : rows) table.add(cells_of(row), cells);
  return table.text();
}

}  // namespace

std::string text_of(const SceneResult& result) {
  return fmt::format("\n{}: {} triangles\n\n", result.scene, with_separators(result.triangles)) + build_table(result) +
         disagreement_table(result) + rate_table(result) + ratio_table(result);
}

std::string summary_of(std::span<const SceneResult> results) {
  struct Sum {
    double logarithms = 0.0;
    double least = 0.0;
    int scenes = 0;
  };
  std::map<RatioRow, std::map<RayKind, Sum>> rows;
  for (const SceneResult& result : results) {
    for (const Ratio& one : ratios_of(result)) {
      Sum& sum = rows[row_of(one)][one.kind];
      sum.least = sum.scenes == 0 ? one.ratio.median : std::min(sum.least, one.ratio.median);
      sum.logarithms += std::log(one.ratio.median);
      ++sum.scenes;
    }
  }
  KindTable table({"over all scenes: geometric mean (worst)", "beside Embree's quickest", "threads"});
  for (const auto& [row, by_kind] : rows) {
    std::map<RayKind, std::string> cells;
    for (const auto& [kind, sum] : by_kind) cells[kind] = fmt::format("{:.2f} ({:.2f})", std::exp(sum.logarithms / sum.scenes), sum.least);
    table.add(cells_of(row), cells);
  }
  return table.text();
}

nlohmann::ordered_json json_of(const SceneResult& result) {
  nlohmann::ordered_json json_scene{{"scene", result.scene}, {"triangles", result.triangles}};
  for (const BuildTime& build : result.builds) {
    json_scene["builds"].push_back({{"structure", build.contender.name},
                                    {"threads", build.threads},
                                    {"seconds", json(spread_of(build.seconds))},
                                    {"rounds", build.seconds},
                                    {"bytes_per_triangle", build.bytes_per_triangle}});
  }
  for (const WayAgreement& one : result.agreements) {
    json_scene["agreement"].push_back({{"structure", one.way.contender.name},
                                       {"rays_per_call", one.way.call_size},
                                       {"rays", name_of(one.way.kind)},
                                       {"count", one.rays},
                                       {"differing", one.differing},
                                       {"unexplained", one.unexplained},
                                       {"timed", one.is_good}});
  }
  for (const WayRate& rate : result.rates) {
    json_scene["rates"].push_back({{"structure", rate.way.contender.name},
                                   {"rays_per_call", rate.way.call_size},
                                   {"rays", name_of(rate.way.kind)},
                                   {"threads", rate.threads},
                                   {"mrays_per_s", json(spread_of(rate.mrays_per_s))},
                                   {"rounds", rate.mrays_per_s}});
  }
  for (const Ratio& one : ratios_of(result)) {
    json_scene["ratios"].push_back({{"structure", one.structure},
                                    {"rays_per_call", one.call_size},
                                    {"rays", name_of(one.kind)},
                                    {"threads", one.threads},
                                    {"group", one.group},
                                    {"rival", one.rival},
                                    {"ratio", json(one.ratio)}});
  }
  return json_scene;
}

}  // namespace grove::bench::rivals
