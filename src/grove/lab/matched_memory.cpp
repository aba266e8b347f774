#include "grove/lab/matched_memory.h"

#include <algorithm>
#include <cmath>

#include "grove/lab/claims/figures.h"
#include "grove/lab/structure_trial.h"
#include "grove/lab/text_table.h"
#include "grove/registry/spec.h"

namespace grove {
namespace {

constexpr int kLargestLeaf = 64;

void check_stop(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Stopped();
}

std::uint64_t bytes_of(const Scene& scene, const std::string& spec) {
  return SceneAccelerator(scene, spec).statistics().bytes;
}

/// The same spec with another leaf size, where its family has one.
std::optional<std::string> with_leaf_size(const std::string& spec, int size) {
  const Spec parsed = Spec::parse(spec);
  std::string text(parsed.family().name);
  char separator = ':';
  bool has_key = false;
  for (const SpecKey& key : parsed.family().keys) {
    const bool is_leaf_size = key.name == "leaf-size";
    has_key = has_key || is_leaf_size;
    text += separator + std::string(key.name) + '=' + (is_leaf_size ? std::to_string(size) : parsed.value(key.name));
    separator = ',';
  }
  return has_key ? std::optional(canonical_spec(text)) : std::nullopt;
}

double distance(std::uint64_t bytes, std::uint64_t wanted) {
  return std::fabs(std::log(static_cast<double>(std::max<std::uint64_t>(1, bytes)) / static_cast<double>(wanted)));
}

}  // namespace

std::vector<MatchedStructure> match_memory(const Scene& scene, std::span<const std::string> specs, std::uint64_t bytes,
                                           std::stop_token stop) {
  std::vector<MatchedStructure> result;
  for (const std::string& spec : specs) {
    const std::string canonical = canonical_spec(spec);
    if (canonical == "brute") continue;
    MatchedStructure one{canonical, {canonical, 0}};
    check_stop(stop);
    one.matched.bytes = bytes_of(scene, canonical);
    for (int size = 1; size <= kLargestLeaf; size *= 2) {
      const std::optional<std::string> sized = with_leaf_size(canonical, size);
      if (!sized || sized == canonical) continue;
      check_stop(stop);
      const std::uint64_t taken = bytes_of(scene, *sized);
      if (distance(taken, bytes) < distance(one.matched.bytes, bytes)) one.matched = {*sized, taken};
    }
    result.push_back(std::move(one));
  }
  return result;
}

ReportSection matched_memory(const Scene& scene, std::span<const std::string> specs, const std::string& camera,
                             const WorkloadSettings& settings, unsigned rounds, std::stop_token stop) {
  std::vector<std::uint64_t> sizes;
  for (const std::string& spec : specs) {
    check_stop(stop);
    if (spec != "brute") sizes.push_back(bytes_of(scene, spec));
  }
  ReportSection section;
  section.title = "At matched memory";
  if (sizes.empty()) {
    section.text = "There is no structure whose memory could be matched.";
    return section;
  }
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  const std::vector<MatchedStructure> matched = match_memory(scene, specs, *middle, stop);
  std::vector<std::string> chosen;
  chosen.reserve(matched.size());
  for (const MatchedStructure& one : matched) chosen.push_back(one.matched.spec);

  const SceneAccelerator accelerator(scene, kDefaultSpec);
  const std::vector<Ray> rays = make_rays(RayKind::diffuse, scene, accelerator, workload_camera(scene, camera), settings);
  TrialSettings trial;
  trial.rounds = rounds;
  trial.stop = stop;
  const std::vector<StructureTrial> trials = try_structures(scene, chosen, rays, trial);
  section.text = "Each structure with the leaf size that makes it take nearest to " + byte_size(*middle) +
                 ", the median of all as they were asked for. Closest hits of diffuse rays on one thread; speeds are against the first.";
  section.table = ReportTable{{"structure", "at", "MiB", "of the median", "nodes a ray", "tests a ray", "ns a ray", "speed"}, {}};
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const auto bytes = static_cast<double>(matched[i].matched.bytes);
    section.table->rows.push_back({matched[i].structure, matched[i].matched.spec, bytes * 0x1p-20, bytes / static_cast<double>(*middle),
                                   trials[i].nodes, trials[i].tests, spread_of(trials[i].nanoseconds).median,
                                   spread_text(speed_ratio(trials[i], trials.front()))});
  }
  return section;
}

}  // namespace grove
