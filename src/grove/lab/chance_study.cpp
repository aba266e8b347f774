#include "grove/lab/chance_study.h"

#include <algorithm>
#include <cmath>

#include "grove/build/octree/octree_r_cost.h"
#include "grove/lab/batch.h"
#include "grove/lab/regression.h"

namespace grove {
namespace {

constexpr std::uint64_t kFewestRays = 500;

/// A ray up to its end, in double.
struct Segment {
  glm::dvec3 origin;
  glm::dvec3 direction;
  double first = 0.0;
  double last = 0.0;

  /// The stretch inside a box; empty (first > last) where there is none.
  [[nodiscard]] Segment inside(const Box& box) const {
    Segment part = *this;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (box.lower[axis] - origin[axis]) / direction[axis];
      const double b = (box.upper[axis] - origin[axis]) / direction[axis];
      // A NaN, from a ray in a face, leaves the stretch as it is.
      part.first = std::fmax(part.first, std::fmin(a, b));
      part.last = std::fmin(part.last, std::fmax(a, b));
    }
    return part;
  }
  [[nodiscard]] bool meets(const Box& box) const {
    const Segment part = inside(box);
    return part.first <= part.last;
  }
};

std::vector<Segment> segments_of(std::span<const Ray> rays, const Accelerator* accelerator) {
  std::vector<Hit> hits;
  if (accelerator != nullptr) {
    hits.resize(rays.size());
    trace(*accelerator, Query::closest, rays, hits);
  }
  std::vector<Segment> segments;
  segments.reserve(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const double end = hits.empty() || !hits[i] ? static_cast<double>(rays[i].t_max) : static_cast<double>(hits[i].t);
    segments.push_back({glm::dvec3(rays[i].origin), glm::dvec3(rays[i].direction), static_cast<double>(rays[i].t_min), end});
  }
  return segments;
}

/// How many segments meet each node and each of its children.
struct Meetings {
  std::vector<std::uint64_t> nodes;
  std::vector<std::uint64_t> children;  // two a node
};

Meetings count_meetings(const Bvh2& tree, std::span<const Segment> segments) {
  Meetings meetings{std::vector<std::uint64_t>(tree.nodes.size()), std::vector<std::uint64_t>(2 * tree.nodes.size())};
  std::vector<std::uint32_t> stack;
  for (const Segment& segment : segments) {
    if (!segment.meets(tree.bounds)) continue;
    stack.assign(1, 0);
    while (!stack.empty()) {
      const std::uint32_t number = stack.back();
      stack.pop_back();
      ++meetings.nodes[number];
      const Bvh2Node& node = tree.nodes[number];
      for (int child = 0; child < 2; ++child) {
        if (!segment.meets(node.child_box(child))) continue;
        ++meetings.children[2 * std::size_t{number} + static_cast<std::size_t>(child)];
        if (node.child[child].count == 0) stack.push_back(node.child[child].first);
      }
    }
  }
  return meetings;
}

void summarise(ChanceStudy& study) {
  double weights = 0.0;
  double ratios = 0.0;
  double squares = 0.0;
  double by_chance = 0.0;
  std::vector<double> expected;
  std::vector<double> measured;
  expected.reserve(study.pairs.size());
  measured.reserve(study.pairs.size());
  for (const ChancePair& pair : study.pairs) {
    const double weight = pair.expected * static_cast<double>(pair.parent_rays);
    const double ratio = pair.measured / pair.expected;
    weights += weight;
    ratios += weight * ratio;
    squares += weight * (ratio - 1.0) * (ratio - 1.0);
    // The variance of a share p of N rays is p (1 - p) / N.
    by_chance += 1.0 - pair.expected;
    expected.push_back(pair.expected);
    measured.push_back(pair.measured);
  }
  if (!(weights > 0.0)) return;
  study.mean_ratio = ratios / weights;
  study.departure = std::sqrt(squares / weights);
  study.noise = std::sqrt(by_chance / weights);
  const double linear = correlation(expected, measured);
  study.r_squared = linear * linear;
}

}  // namespace

ChanceStudy study_chances(const Bvh2& tree, std::span<const Ray> rays, const Accelerator* accelerator) {
  ChanceStudy study;
  if (tree.nodes.empty()) return study;
  const Meetings meetings = count_meetings(tree, segments_of(rays, accelerator));
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    if (meetings.nodes[i] < kFewestRays) continue;
    const Bvh2Node& node = tree.nodes[i];
    Box whole = node.child_box(0);
    whole.grow(node.child_box(1));
    const double area = static_cast<double>(whole.half_area());
    for (int child = 0; child < 2; ++child) {
      const double expected = area > 0.0 ? static_cast<double>(node.child_box(child).half_area()) / area : 0.0;
      if (!(expected > 0.0)) continue;
      const std::uint64_t met = meetings.children[2 * i + static_cast<std::size_t>(child)];
      study.pairs.push_back({expected, static_cast<double>(met) / static_cast<double>(meetings.nodes[i]), meetings.nodes[i]});
    }
  }
  summarise(study);
  return study;
}

std::vector<PlaneTests> study_expected_tests(const ReferenceList& list, int axis, unsigned plane_count, std::span<const Ray> rays,
                                             const Accelerator* accelerator) {
  std::vector<double> begins;
  std::vector<double> ends;
  begins.reserve(list.references.size());
  ends.reserve(list.references.size());
  for (const PrimitiveReference& reference : list.references) {
    const Box box = reference.box().box();
    begins.push_back(box.lower[axis]);
    ends.push_back(box.upper[axis]);
  }
  // From where to where each ray goes along the axis while it is inside.
  std::vector<double> lows;
  std::vector<double> highs;
  for (const Segment& segment : segments_of(rays, accelerator)) {
    const Segment part = segment.inside(list.bounds);
    if (!(part.first <= part.last)) continue;
    const double a = part.origin[axis] + part.first * part.direction[axis];
    const double b = part.origin[axis] + part.last * part.direction[axis];
    lows.push_back(std::fmin(a, b));
    highs.push_back(std::fmax(a, b));
  }
  for (std::vector<double>* const figures : {&begins, &ends, &lows, &highs}) std::ranges::sort(*figures);
  const auto below = [](const std::vector<double>& sorted, double position) {
    return static_cast<double>(std::ranges::lower_bound(sorted, position) - sorted.begin());
  };

  const glm::dvec3 lower(list.bounds.lower);
  const glm::dvec3 side = glm::dvec3(list.bounds.upper) - lower;
  const DividedSpace space{side[axis], side[(axis + 1) % 3], side[(axis + 2) % 3]};
  const auto n = static_cast<double>(begins.size());
  const auto ray_count = static_cast<double>(lows.size());
  std::vector<PlaneTests> planes;
  if (lows.empty() || !(space.a > 0.0)) return planes;
  planes.reserve(plane_count);
  for (unsigned i = 1; i <= plane_count; ++i) {
    const double t = space.a * i / (plane_count + 1);
    const double position = lower[axis] + t;
    const double wholly_below = below(ends, position);
    const double wholly_above = n - below(begins, position);
    const DividedCounts counts{wholly_below, wholly_above, n - wholly_below - wholly_above};
    const double through_below = below(lows, position) / ray_count;
    const double through_above = 1.0 - below(highs, position) / ray_count;
    planes.push_back({position, expected_tests(space, t, counts), expected_tests(through_below, through_above, counts)});
  }
  return planes;
}

}  // namespace grove
