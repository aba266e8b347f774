// Kd-trees over points beside nanoflann's: building, and the k nearest of many queries, on one pinned thread and on all. In one process, round by round; the
// figures are ratios within a round. The distances that both find are compared first, bit for bit.

#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nanoflann.hpp>
#include <nlohmann/json.hpp>
#include <thread>

#include "grove/base/error.h"
#include "grove/base/output_file.h"
#include "grove/base/parallel.h"
#include "grove/base/random.h"
#include "grove/base/timer.h"
#include "grove/build/points/build_point_kd_tree.h"
#include "grove/lab/machine.h"
#include "grove/lab/pinned.h"
#include "grove/lab/spread.h"
#include "grove/traverse/points/point_search.h"
#include "program.h"

namespace grove::bench {
namespace {

using Points = std::vector<Point<3>>;

/// How nanoflann reaches points.
struct Cloud {
  const Points& points;

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] float kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][axis]; }
  template <typename Bounds>
  bool kdtree_get_bbox(Bounds& /*bounds*/) const {
    return false;
  }
};

using Rival = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Cloud>, Cloud, 3, std::uint32_t>;

Points uniform(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  Points points(count);
  for (Point<3>& point : points)
    for (float& c : point) c = random.next_float();
  return points;
}

/// Sums of four uniform steps about one of a hundred centres, of three widths.
Points clustered(std::size_t count, std::uint64_t seed) {
  const Points centres = uniform(100, 99);
  Random random(seed);
  Points points(count);
  for (Point<3>& point : points) {
    const std::uint32_t cluster = random.next_u32(100);
    const float width = cluster % 3 == 0 ? 0.001F : cluster % 3 == 1 ? 0.01F : 0.1F;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      float step = -2.0F;
      for (int i = 0; i < 4; ++i) step += random.next_float();
      point[axis] = centres[cluster][axis] + width * step;
    }
  }
  return points;
}

nlohmann::json json(const Spread& spread) {
  return {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}};
}

std::string text(const Spread& spread) {
  return fmt::format("{:.2f} ({:.2f}-{:.2f})", spread.median, spread.min, spread.max);
}

/// Seconds of ours and of the rival's, round by round.
struct Measured {
  std::string name;
  double count = 0.0;  // of points or queries
  std::vector<double> ours;
  std::vector<double> rivals;

  [[nodiscard]] Spread speed() const {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < ours.size(); ++i) ratios.push_back(rivals[i] / ours[i]);
    return spread_of(ratios);
  }
};

template <typename Work>
double seconds_of(const Work& work) {
  const Timer timer;
  work();
  return timer.seconds();
}

void search(const Rival& rival, const Points& queries, std::size_t k, std::vector<std::uint32_t>& ids, std::vector<float>& distances) {
  parallel_for(queries.size(), 256,
               [&](std::size_t i) { rival.knnSearch(queries[i].data(), k, ids.data() + i * k, distances.data() + i * k); });
}

std::uint64_t count_disagreements(const std::vector<PointNeighbour>& found, const std::vector<float>& distances) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < found.size(); ++i) count += found[i].squared_distance == distances[i] ? 0 : 1;
  return count;
}

std::vector<Measured> measure(const Points& points, const Points& queries, std::size_t leaf_size, int threads, int rounds) {
  const Cloud cloud{points};
  std::vector<Measured> rows;
  const auto row = [&](std::size_t i, std::string name, double count) -> Measured& {
    if (rows.size() <= i) rows.push_back({std::move(name), count, {}, {}});
    return rows[i];
  };
  for (int round = 0; round < rounds; ++round) {
    std::size_t next = 0;
    for (const int count : {1, threads}) {
      oneapi::tbb::task_arena arena(count);
      arena.execute([&] {
        const std::unique_ptr<Pinned> pinned = count == 1 ? std::make_unique<Pinned>() : nullptr;
        const std::string suffix = fmt::format(", {} thread{}", count, count == 1 ? "" : "s");
        PointKdTree<3> tree;
        Measured& building = row(next++, "build" + suffix, static_cast<double>(points.size()));
        building.ours.push_back(seconds_of([&] { tree = build_point_kd_tree<3>(points); }));
        // Builds as it is made, in one thread.
        std::unique_ptr<Rival> rival;
        building.rivals.push_back(
            seconds_of([&] { rival = std::make_unique<Rival>(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(leaf_size)); }));
        for (const std::size_t k : {1, 8, 16}) {
          std::vector<PointNeighbour> found(k * queries.size());
          std::vector<std::uint32_t> ids(found.size());
          std::vector<float> distances(found.size());
          Measured& searching = row(next++, fmt::format("{} nearest{}", k, suffix), static_cast<double>(queries.size()));
          searching.ours.push_back(seconds_of([&] { PointSearch<3>(tree).nearest(queries, k, found); }));
          searching.rivals.push_back(seconds_of([&] { search(*rival, queries, k, ids, distances); }));
          const std::uint64_t disagreements = count_disagreements(found, distances);
          if (disagreements > 0) throw InputError(fmt::format("{} of {} distances are not nanoflann's", disagreements, found.size()));
        }
      });
    }
  }
  return rows;
}

int run(int argc, char** argv) {
  std::size_t count = 1000000;
  std::size_t query_count = 200000;
  std::size_t leaf_size = 10;
  int rounds = 5;
  std::string path;
  CLI::App app{"Kd-trees over points beside nanoflann's, in three dimensions."};
  app.add_option("--points", count, "points")->check(CLI::Range(1, 100000000))->capture_default_str();
  app.add_option("--queries", query_count, "queries, distributed as the points are")
      ->check(CLI::Range(1, 100000000))
      ->capture_default_str();
  app.add_option("--leaf-size", leaf_size, "nanoflann's leaves; 10 is its default")->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--rounds", rounds, "rounds")->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--json", path, "write the figures here");
  CLI11_PARSE(app, argc, argv);
  const Machine machine = describe_machine();
  const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  fmt::print("{}, {} cores, {}, {}; nanoflann {:#x}, leaves of {}\n", machine.cpu, machine.cores, machine.compiler, machine.os,
             NANOFLANN_VERSION, leaf_size);
  nlohmann::json report{{"machine", {{"cpu", machine.cpu}, {"cores", machine.cores}, {"compiler", machine.compiler}, {"os", machine.os}}}};
  for (const std::string& layout : {std::string("uniform"), std::string("clustered")}) {
    const auto make = layout == "uniform" ? uniform : clustered;
    const Points points = make(count, 1);
    const Points queries = make(query_count, 2);
    fmt::print("\n| {}, {} points | Grove ns a point or query | nanoflann | times as fast |\n| --- | ---: | ---: | ---: |\n", layout,
               count);
    for (const Measured& row : measure(points, queries, leaf_size, threads, rounds)) {
      const Spread ours = spread_of(row.ours);
      const Spread rivals = spread_of(row.rivals);
      fmt::print("| {} | {:.0f} | {:.0f} | {} |\n", row.name, 1e9 * ours.median / row.count, 1e9 * rivals.median / row.count,
                 text(row.speed()));
      report["rows"].push_back({{"layout", layout},
                                {"points", count},
                                {"name", row.name},
                                {"seconds", json(ours)},
                                {"seconds_nanoflann", json(rivals)},
                                {"times_as_fast", json(row.speed())}});
    }
  }
  if (!path.empty()) write_text_file(path, report.dump(2) + "\n");
  return 0;
}

}  // namespace
}  // namespace grove::bench

int main(int argc, char** argv) {
  return grove::bench::run_program("grove_point_bench", grove::bench::run, argc, argv);
}
