#include "grove/lab/animation.h"

#include <algorithm>

#include "grove/base/error.h"
#include "grove/base/timer.h"
#include "grove/scene/load.h"

namespace grove {
namespace {

/// A structure that follows the scene by one policy, over a mesh of its own.
struct Follower {
  UpdatePolicy policy;
  std::shared_ptr<TriangleMesh> mesh;
  std::unique_ptr<Accelerator> structure;
};

const TriangleMesh& mesh_of(const Scene& scene) {
  const auto* const mesh =
      scene.objects.size() == 1 ? std::get_if<std::shared_ptr<TriangleMesh>>(&scene.objects.front().geometry) : nullptr;
  if (mesh == nullptr) throw InputError(scene.name + ": to be played, a scene must be one object of triangles");
  return **mesh;
}

AnimationRow play(Follower& follower, const Scene& scene, std::span<const Ray> rays, std::span<const Hit> expected,
                  const AnimationSettings& settings) {
  AnimationRow row;
  row.policy = follower.policy;
  follower.mesh->move_vertices(mesh_of(scene).vertices());
  row.update = follower.structure->update({follower.policy, static_cast<double>(rays.size())});
  std::vector<Hit> hits(rays.size());
  const Query query = query_of(settings.rays);
  const Timer timer;
  trace(*follower.structure, query, rays, hits);
  row.trace_seconds = timer.seconds();
  const auto count = static_cast<double>(rays.size());
  row.mrays_per_s = 1e-6 * count / row.trace_seconds;
  const TraversalCounts counts = trace_counted(*follower.structure, query, rays, hits);
  row.nodes_per_ray = static_cast<double>(counts.nodes_visited) / count;
  row.tests_per_ray = static_cast<double>(counts.primitives_tested) / count;
  for (std::size_t i = 0; i < hits.size(); ++i) row.mismatches += same_bits(hits[i], expected[i]) ? 0 : 1;
  return row;
}

}  // namespace

MovingScene moving_scene(const std::string& source) {
  constexpr std::string_view kPrefix = "builtin:";
  const std::vector<std::string> moving = moving_builtin_scenes();
  const std::string name = source.starts_with(kPrefix) ? source.substr(kPrefix.size(), source.find('?') - kPrefix.size()) : "";
  if (std::find(moving.begin(), moving.end(), name) == moving.end()) {
    std::string known;
    for (const std::string& scene : moving) known += (known.empty() ? "builtin:" : ", builtin:") + scene;
    throw UsageError("'" + source + "' does not move; scenes that do are " + known);
  }
  const char separator = source.find('?') == std::string::npos ? '?' : '&';
  return [source, separator](double time) { return load_scene(source + separator + "time=" + std::to_string(time)); };
}

Animation animate(const MovingScene& scene, const AnimationSettings& settings, const ProgressReporter& progress) {
  Animation animation;
  animation.rays = settings.rays;
  animation.machine = describe_machine();
  std::vector<Follower> followers;
  {
    const Scene first = scene(0.0);
    const TriangleMesh& mesh = mesh_of(first);
    animation.scene = first.name;
    animation.primitives = mesh.size();
    for (const UpdatePolicy policy : settings.policies) {
      const auto own = std::make_shared<TriangleMesh>(mesh);
      followers.push_back({policy, own, build(GeometryPointer(std::shared_ptr<const TriangleMesh>(own)), settings.structure)});
      animation.structure = followers.back().structure->spec();
    }
  }
  for (unsigned frame = 0; frame < settings.frames && !progress.stop.stop_requested(); ++frame) {
    const double time = settings.frames > 1 ? static_cast<double>(frame) / (settings.frames - 1) : 0.0;
    const Scene now = scene(time);
    if (!std::ranges::equal(mesh_of(now).triangles(), followers.empty() ? mesh_of(now).triangles() : followers.front().mesh->triangles()))
      throw InputError(now.name + ": its triangles are not those of the first frame");
    const SceneAccelerator anew(now, settings.structure);
    const std::vector<Ray> rays = make_rays(settings.rays, now, anew, workload_camera(now, ""), settings.workload);
    animation.ray_count = rays.size();
    std::vector<Hit> expected(rays.size());
    trace(anew.top(), query_of(settings.rays), rays, expected);
    for (Follower& follower : followers) {
      AnimationRow row = play(follower, now, rays, expected, settings);
      row.frame = frame;
      row.time = time;
      animation.rows.push_back(row);
    }
    if (progress.report) progress.report(frame + 1, settings.frames);
  }
  return animation;
}

}  // namespace grove
