// What following changes costs, and what it costs rays: in each round a share of the triangles moves, or is taken away and as many are put elsewhere, and each
// structure follows by each policy, told what changed. Beside the time of the update stand the expected cost and what rays do, relative to the
// structure built anew; every hit is checked against its.

#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <thread>

#include "grove/base/output_file.h"
#include "grove/base/random.h"
#include "grove/lab/machine.h"
#include "grove/lab/spread.h"
#include "grove/lab/workload.h"
#include "grove/registry/registry.h"
#include "grove/scene/load.h"
#include "program.h"
#include "trace/world_mesh.h"

namespace grove::bench {
namespace {

struct Options {
  std::vector<std::string> scenes;
  std::vector<std::string> structures;
  std::vector<std::string> policies{"refit", "auto", "rebuild"};
  std::vector<std::string> changes{"move", "replace"};
  std::vector<double> shares{0.01, 0.1};
  double reach = 0.05;
  double rays = 1e6;
  std::size_t count = 5000;
  int rounds = 100;
  int threads = 1;
  std::string csv;
};

/// The triangles of a mesh with vertices of their own, so that each can move alone.
TriangleMesh unshared(const TriangleMesh& mesh) {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  vertices.reserve(3 * mesh.size());
  triangles.reserve(mesh.size());
  for (std::uint32_t i = 0; i < mesh.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) vertices.push_back(mesh.vertices()[mesh.triangles()[i][corner]]);
    triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  return {std::move(vertices), std::move(triangles)};
}

/// A way to follow the changes, over a mesh of its own.
struct Way {
  std::string spec;
  UpdatePolicy policy;
  std::shared_ptr<TriangleMesh> mesh;
  std::unique_ptr<Accelerator> structure;
};

struct Row {
  int round = 0;
  UpdateReport update;
  double nodes = 0.0;  // a ray
  double tests = 0.0;
  std::uint64_t mismatches = 0;

  [[nodiscard]] double steps() const { return nodes + tests; }
};

/// Changes meshes that are alike in the same way.
class Changes {
 public:
  Changes(const TriangleMesh& mesh, double reach) : random_(7) {
    for (std::uint32_t i = 0; i < mesh.size(); ++i) {
      bounds_.grow(mesh.bounds(i));
      if (!mesh.bounds(i).is_empty()) alive_.push_back(i);
    }
    reach_ = static_cast<float>(reach) * glm::length(bounds_.extent());
  }

  /// Moves so many triangles by up to the reach, back where they would leave the scene.
  std::vector<std::uint32_t> move(std::size_t count, std::span<const Way> ways) {
    std::vector<std::uint32_t> changed;
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t i = alive_[random_.next_u32(static_cast<std::uint32_t>(alive_.size()))];
      Vec3 by = reach_ * (2.0F * random_point() - Vec3(1.0F));
      const Vec3 centre = ways.front().mesh->bounds(i).centre();
      for (int axis = 0; axis < 3; ++axis)
        if (centre[axis] + by[axis] < bounds_.lower[axis] || centre[axis] + by[axis] > bounds_.upper[axis]) by[axis] = -by[axis];
      for (const Way& way : ways)
        for (int corner = 0; corner < 3; ++corner) {
          const std::uint32_t vertex = way.mesh->triangles()[i][corner];
          way.mesh->move_vertex(vertex, way.mesh->vertices()[vertex] + by);
        }
      changed.push_back(i);
    }
    return changed;
  }

  /// Removes so many triangles, and adds one of the same shape anywhere for each.
  std::vector<std::uint32_t> replace(std::size_t count, std::span<const Way> ways) {
    std::vector<std::uint32_t> changed;
    for (std::size_t k = 0; k < count; ++k) {
      std::uint32_t& place = alive_[random_.next_u32(static_cast<std::uint32_t>(alive_.size()))];
      const std::uint32_t i = place;
      const Vec3 centre = bounds_.lower + bounds_.extent() * random_point();
      const Vec3 by = centre - ways.front().mesh->bounds(i).centre();
      changed.push_back(i);
      for (const Way& way : ways) {
        std::vector<Vec3> corners;
        for (int corner = 0; corner < 3; ++corner) corners.push_back(way.mesh->vertices()[way.mesh->triangles()[i][corner]] + by);
        way.mesh->remove_triangle(i);
        const auto first = static_cast<std::uint32_t>(way.mesh->vertices().size());
        const std::vector<Triangle> triangles{{first, first + 1, first + 2}};
        place = way.mesh->extend_last_part(corners, triangles);
      }
      changed.push_back(place);
    }
    return changed;
  }

 private:
  Vec3 random_point() {
    const float x = random_.next_float();
    const float y = random_.next_float();
    return {x, y, random_.next_float()};
  }

  Random random_;
  Box bounds_;
  std::vector<std::uint32_t> alive_;
  float reach_ = 0.0F;
};

std::string text(const Spread& spread, double scale) {
  return fmt::format("{:.3g} ({:.3g}-{:.3g})", scale * spread.median, scale * spread.min, scale * spread.max);
}

/// Plays one kind of change. Returns the rows of each way.
std::vector<std::vector<Row>> play(const std::string& change, double share, const TriangleMesh& mesh, std::span<const Ray> rays,
                                   std::vector<Way>& ways, const Options& options) {
  Changes changes(mesh, options.reach);
  const auto count = static_cast<std::size_t>(std::max(1.0, share * static_cast<double>(mesh.size())));
  std::vector<std::vector<Row>> rows(ways.size());
  for (int round = 0; round < options.rounds; ++round) {
    const std::vector<std::uint32_t> changed = change == "move" ? changes.move(count, ways) : changes.replace(count, ways);
    std::vector<Hit> expected;
    for (std::size_t k = ways.size(); k-- > 0;) {
      // The last way, which builds anew, goes first: its hits are what others are checked against.
      Row row;
      row.round = round;
      row.update = ways[k].structure->update({ways[k].policy, options.rays, changed});
      std::vector<Hit> hits(rays.size());
      const TraversalCounts counts = trace_counted(*ways[k].structure, Query::closest, rays, hits);
      row.nodes = static_cast<double>(counts.nodes_visited) / static_cast<double>(rays.size());
      row.tests = static_cast<double>(counts.primitives_tested) / static_cast<double>(rays.size());
      if (expected.empty()) expected = hits;
      for (std::size_t i = 0; i < hits.size(); ++i) row.mismatches += same_bits(hits[i], expected[i]) ? 0 : 1;
      rows[k].push_back(row);
    }
  }
  return rows;
}

void print(const std::vector<Way>& ways, const std::vector<std::vector<Row>>& rows, const std::string& title) {
  fmt::print(
      "\n| {} | update ms | times as fast as rebuilding | cost at the end | nodes + tests a ray | mismatches | rebuilt a round | whole "
      "rebuilds |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n",
      title);
  for (std::size_t k = 0; k < ways.size(); ++k) {
    // The same structure, built anew.
    std::size_t anew = k;
    for (std::size_t j = 0; j < ways.size(); ++j)
      if (ways[j].spec == ways[k].spec && ways[j].policy == UpdatePolicy::rebuild) anew = j;
    std::vector<double> seconds;
    std::vector<double> speed;
    double rebuilt = 0.0;
    std::uint64_t mismatches = 0;
    int whole = 0;
    // The first update of a structure learns what the later ones know.
    for (std::size_t i = std::min<std::size_t>(1, rows[k].size() - 1); i < rows[k].size(); ++i) {
      seconds.push_back(rows[k][i].update.seconds);
      speed.push_back(rows[anew][i].update.seconds / rows[k][i].update.seconds);
      rebuilt += static_cast<double>(rows[k][i].update.rebuilt_references) / static_cast<double>(rows[k].size());
      whole += rows[k][i].update.method == UpdateMethod::rebuild ? 1 : 0;
      mismatches += rows[k][i].mismatches;
    }
    fmt::print("| `{}` {} | {} | {} | {:.3f} | {:.3f} | {} | {:.0f} | {} |\n", ways[k].spec, name_of(ways[k].policy),
               text(spread_of(seconds), 1e3), text(spread_of(speed), 1.0), rows[k].back().update.cost / rows[anew].back().update.cost,
               rows[k].back().steps() / rows[anew].back().steps(), mismatches, rebuilt, whole);
  }
}

void run_scene(const std::string& source, const Options& options, std::string& csv) {
  const Scene scene = load_scene(source);
  const auto mesh = std::make_shared<const TriangleMesh>(unshared(*world_mesh(scene)));
  const Scene traced = scene_of(scene, mesh);
  const SceneAccelerator accelerator(traced, "bvh");
  const std::vector<Ray> rays = make_rays(RayKind::diffuse, traced, accelerator, workload_camera(traced, ""), {options.count, 1});
  for (const std::string& change : options.changes) {
    for (const double share : options.shares) {
      std::vector<Way> ways;
      for (const std::string& spec : options.structures) {
        for (const std::string& policy : options.policies) {
          const auto own = std::make_shared<TriangleMesh>(*mesh);
          ways.push_back({canonical_spec(spec), parse_update_policy(policy), own,
                          build(GeometryPointer(std::shared_ptr<const TriangleMesh>(own)), spec)});
        }
      }
      const std::vector<std::vector<Row>> rows = play(change, share, *mesh, rays, ways, options);
      print(ways, rows, fmt::format("{}, {} triangles: {} {:g} %", source, mesh->size(), change, 100.0 * share));
      for (std::size_t k = 0; k < ways.size(); ++k) {
        for (const Row& row : rows[k])
          csv += fmt::format("\"{}\",{},{},{},\"{}\",{},{},{},{},{},{},{}\n", source, change, share, row.round, ways[k].spec,
                             name_of(ways[k].policy), row.update.seconds, row.update.cost, row.nodes, row.tests,
                             row.update.rebuilt_references, name_of(row.update.method));
      }
    }
  }
}

int run(int argc, char** argv) {
  Options options;
  CLI::App app{"Following changes beside building anew."};
  app.add_option("scenes", options.scenes, "files or built-in scenes; by default a terrain of 100,000 triangles and 30,000 long thin ones");
  app.add_option("--structure", options.structures, "specs to follow with")->default_str("kdtree bvh");
  app.add_option("--policy", options.policies, "refit, rotate, auto; rebuild must be the last")->capture_default_str();
  app.add_option("--change", options.changes, "move, replace")->check(CLI::IsMember({"move", "replace"}))->capture_default_str();
  app.add_option("--share", options.shares, "of the triangles, each round")->check(CLI::Range(0.0, 1.0))->capture_default_str();
  app.add_option("--reach", options.reach, "how far they move at most, of the scene's diagonal, an axis")->capture_default_str();
  app.add_option("--rays", options.rays, "rays that updates should expect")->capture_default_str();
  app.add_option("--count", options.count, "diffuse rays to trace")->capture_default_str();
  app.add_option("--rounds", options.rounds, "rounds of changes")->check(CLI::Range(2, 100000))->capture_default_str();
  app.add_option("--threads", options.threads, "threads that updates may use")->check(CLI::Range(1, 1024))->capture_default_str();
  app.add_option("--csv", options.csv, "write all rounds here; bench/plots/updates.py draws them");
  CLI11_PARSE(app, argc, argv);
  if (options.scenes.empty()) options.scenes = {"builtin:mount?triangles=100000", "builtin:soup?triangles=30000"};
  if (options.structures.empty()) options.structures = {"kdtree", "bvh"};
  if (options.policies.empty() || options.policies.back() != "rebuild") options.policies.emplace_back("rebuild");
  const Machine machine = describe_machine();
  fmt::print("{}, {} cores, {}, {}; {} threads\n", machine.cpu, machine.cores, machine.compiler, machine.os, options.threads);
  std::string csv = "scene,change,share,round,structure,policy,seconds,cost,nodes_per_ray,tests_per_ray,rebuilt_references,method\n";
  oneapi::tbb::task_arena arena(options.threads);
  arena.execute([&] {
    for (const std::string& scene : options.scenes) run_scene(scene, options, csv);
  });
  if (!options.csv.empty()) write_text_file(options.csv, csv);
  return 0;
}

}  // namespace
}  // namespace grove::bench

int main(int argc, char** argv) {
  return grove::bench::run_program("grove_update_bench", grove::bench::run, argc, argv);
}
