#include "grove/lab/recorded_rays.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "grove/base/random.h"
#include "grove/render/record_rays.h"

namespace grove {
namespace {

/// Paths that tell how many rays a path has.
constexpr double kPilotPaths = 4096.0;
/// More paths than the pilot says are needed: its mean is off by a few percent.
constexpr double kReserve = 1.1;

/// A picture of the aspect that the scene asks for, of about that many pixels.
RecordSettings picture_of(const Scene& scene, double pixels, std::uint64_t seed) {
  const bool has_size = scene.film.width > 0 && scene.film.height > 0;
  const double aspect = has_size ? static_cast<double>(scene.film.width) / scene.film.height : 16.0 / 9.0;
  const double height = std::max(1.0, std::round(std::sqrt(pixels / aspect)));
  RecordSettings settings;
  settings.height = static_cast<std::uint32_t>(height);
  settings.width = static_cast<std::uint32_t>(std::max(1.0, std::ceil(pixels / height)));
  settings.seed = seed;
  return settings;
}

/// Leaves `count` of the rays, by chance (a fixed step would favour some bounces where paths are equally long), in the order that they have.
void take_sample(std::vector<RecordedRay>& rays, std::size_t count, std::uint64_t seed) {
  if (rays.size() <= count) return;
  Random random(mix_bits(seed));
  std::size_t taken = 0;
  // Each ray is taken with the chance that those still wanted are of those still to come (Knuth, TAOCP 3.4.2, algorithm S).
  for (std::size_t i = 0; taken < count; ++i) {
    const double chance = static_cast<double>(count - taken) / static_cast<double>(rays.size() - i);
    if (random.next_float() < chance) rays[taken++] = rays[i];
  }
  rays.resize(count);
}

/// Those of one bounce, or all: closest hits first, each in the order in which they were shot.
RaySet select(const std::vector<RecordedRay>& recorded, std::string name, const auto& is_chosen) {
  RaySet set;
  set.name = std::move(name);
  set.rays.reserve(static_cast<std::size_t>(std::ranges::count_if(recorded, is_chosen)));
  for (const RecordedRay& one : recorded)
    if (!one.asks_any && is_chosen(one)) set.rays.push_back(one.ray);
  set.closest_count = set.rays.size();
  for (const RecordedRay& one : recorded)
    if (one.asks_any && is_chosen(one)) set.rays.push_back(one.ray);
  return set;
}

}  // namespace

std::vector<RaySet> recorded_rays(const Scene& scene, const SceneAccelerator& accelerator, const Camera& camera,
                                  const WorkloadSettings& settings) {
  const auto wanted = static_cast<double>(settings.ray_count);
  const RecordSettings pilot = picture_of(scene, std::min(kPilotPaths, wanted), settings.seed);
  std::vector<RecordedRay> recorded = record_rays(scene, accelerator, camera, pilot);
  const double pilot_paths = static_cast<double>(pilot.width) * pilot.height;
  const double rays_per_path = static_cast<double>(recorded.size()) / pilot_paths;
  recorded = record_rays(scene, accelerator, camera, picture_of(scene, std::max(1.0, kReserve * wanted / rays_per_path), settings.seed));

  take_sample(recorded, settings.ray_count, settings.seed);
  std::uint32_t last_bounce = 0;
  for (const RecordedRay& one : recorded) last_bounce = std::max(last_bounce, one.bounce);
  std::vector<RaySet> sets;
  sets.reserve(last_bounce + 2);
  const std::string name(name_of(RayKind::recorded));
  sets.push_back(select(recorded, name, [](const RecordedRay&) { return true; }));
  for (std::uint32_t bounce = 0; bounce <= last_bounce; ++bounce) {
    RaySet set = select(recorded, name + '-' + std::to_string(bounce), [&](const RecordedRay& one) { return one.bounce == bounce; });
    if (set.size() > 0) sets.push_back(std::move(set));
  }
  return sets;
}

}  // namespace grove
