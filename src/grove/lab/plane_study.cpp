#include "grove/lab/plane_study.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

#include "grove/build/octree/octree_r_cost.h"
#include "grove/math/box.h"

namespace grove {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kCandidates = 8;

double centre_of(const Box& box, int axis) {
  return 0.5 * (static_cast<double>(box.lower[axis]) + static_cast<double>(box.upper[axis]));
}

/// A plane that could be taken: it may lie anywhere from `from` to `to` with the same result.
struct Plane {
  double from = 0.0, to = 0.0;
  double cost = kInfinity;  ///< for a ray that meets the node
  std::size_t left = 0, right = 0;
  double left_area = 0.0, right_area = 0.0;
};

/// All planes of one axis, by position, and its medians.
struct AxisPlanes {
  int axis = 0;
  std::vector<Plane> planes;
  double spatial_median = 0.0;
  double object_median = 0.0;

  [[nodiscard]] double low() const { return std::min(spatial_median, object_median); }
  [[nodiscard]] double high() const { return std::max(spatial_median, object_median); }
  [[nodiscard]] static bool meets(const Plane& plane, double low, double high) { return plane.from <= high && plane.to >= low; }

  [[nodiscard]] const Plane* cheapest(double low, double high) const {
    const Plane* best = nullptr;
    for (const Plane& plane : planes) {
      if (meets(plane, low, high) && (best == nullptr || plane.cost < best->cost)) best = &plane;
    }
    return best;
  }
  [[nodiscard]] double cost_between() const {
    const Plane* const best = cheapest(low(), high());
    return best == nullptr ? kInfinity : best->cost;
  }
  /// Of the plane that has this position; beyond all, of none.
  [[nodiscard]] double cost_at(double position) const {
    const auto found = std::ranges::lower_bound(planes, position, {}, &Plane::to);
    return found == planes.end() || found->from > position ? kInfinity : found->cost;
  }
  /// Equally spaced from the spatial median, number 0, to the object median.
  [[nodiscard]] double candidate(int number) const {
    return spatial_median + (object_median - spatial_median) * number / (kCandidates - 1);
  }
  [[nodiscard]] double cost_of_candidates() const {
    double best = kInfinity;
    for (int i = 0; i < kCandidates; ++i) best = std::min(best, cost_at(candidate(i)));
    return best;
  }
};

AxisPlanes planes_between_objects(std::span<Box> boxes, const Box& node, int axis) {
  std::sort(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) { return centre_of(a, axis) < centre_of(b, axis); });
  const std::size_t n = boxes.size();
  std::vector<double> right_area(n + 1, 0.0);
  Box box;
  for (std::size_t i = n; i-- > 0;) {
    box.grow(boxes[i]);
    right_area[i] = static_cast<double>(box.half_area());
  }
  AxisPlanes result{axis, {}, centre_of(node, axis), centre_of(boxes[n / 2], axis)};
  const double whole = right_area[0];
  Box left;
  for (std::size_t i = 1; i < n && whole > 0.0; ++i) {
    left.grow(boxes[i - 1]);
    const Plane plane{
        centre_of(boxes[i - 1], axis), centre_of(boxes[i], axis), 0.0, i, n - i, static_cast<double>(left.half_area()), right_area[i]};
    // No plane parts equal centres.
    if (!(plane.from < plane.to)) continue;
    result.planes.push_back(plane);
    result.planes.back().cost = (plane.left_area * static_cast<double>(i) + plane.right_area * static_cast<double>(n - i)) / whole;
  }
  return result;
}

AxisPlanes planes_of_cell(std::span<const Box> boxes, const Box& cell, int axis) {
  const std::size_t n = boxes.size();
  std::vector<double> begins;
  std::vector<double> ends;
  std::vector<double> centres;
  begins.reserve(n);
  ends.reserve(n);
  centres.reserve(n);
  for (const Box& box : boxes) {
    begins.push_back(box.lower[axis]);
    ends.push_back(box.upper[axis]);
    centres.push_back(centre_of(box, axis));
  }
  std::ranges::sort(begins);
  std::ranges::sort(ends);
  std::ranges::nth_element(centres, centres.begin() + static_cast<std::ptrdiff_t>(n / 2));
  AxisPlanes result{axis, {}, centre_of(cell, axis), centres[n / 2]};
  std::vector<double> positions;
  positions.reserve(2 * n + kCandidates);
  std::ranges::merge(begins, ends, std::back_inserter(positions));
  // The medians and the candidates are planes, too, wherever they lie.
  for (int i = 0; i < kCandidates; ++i) positions.push_back(result.candidate(i));
  std::ranges::sort(positions);
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
  const double lower = cell.lower[axis];
  const double upper = cell.upper[axis];
  const glm::dvec3 side = glm::dvec3(cell.upper) - glm::dvec3(cell.lower);
  const DividedSpace space{side[axis], side[(axis + 1) % 3], side[(axis + 2) % 3]};
  for (const double position : positions) {
    if (!(position > lower && position < upper)) continue;
    const auto below = static_cast<std::size_t>(std::ranges::upper_bound(ends, position) - ends.begin());
    const auto not_above = static_cast<std::size_t>(std::ranges::lower_bound(begins, position) - begins.begin());
    // What lies in the plane counts as below alone.
    const std::size_t above = n - std::max(not_above, below);
    const std::size_t across = n - below - above;
    const DividedCounts counts{static_cast<double>(below), static_cast<double>(above), static_cast<double>(across)};
    const double t = position - lower;
    result.planes.push_back({position, position, expected_tests(space, t, counts), below + across, above + across, chance_below(space, t),
                             chance_above(space, t)});
  }
  return result;
}

class Study {
 public:
  Study(PartedBy parted_by, unsigned levels, std::size_t smallest) : parted_by_(parted_by), smallest_(smallest) {
    study_.levels.resize(levels);
  }

  void part(std::vector<Box> boxes, const Box& node, unsigned level) {
    if (level >= study_.levels.size() || boxes.size() <= smallest_) return;
    std::optional<AxisPlanes> best_axis;
    Plane best;
    PlaneTally tally;
    double costs[4] = {kInfinity, kInfinity, kInfinity, kInfinity};
    for (int axis = 0; axis < 3; ++axis) {
      AxisPlanes axis_planes =
          parted_by_ == PartedBy::objects ? planes_between_objects(boxes, node, axis) : planes_of_cell(boxes, node, axis);
      const Plane* const cheapest = axis_planes.cheapest(-kInfinity, kInfinity);
      if (cheapest == nullptr) continue;
      ++tally.axes;
      tally.between_on_axis += AxisPlanes::meets(*cheapest, axis_planes.low(), axis_planes.high()) ? 1 : 0;
      const double found[4] = {axis_planes.cost_between(), axis_planes.cost_of_candidates(),
                               axis_planes.cost_at(axis_planes.spatial_median), axis_planes.cost_at(axis_planes.object_median)};
      for (int i = 0; i < 4; ++i) costs[i] = std::min(costs[i], found[i]);
      if (cheapest->cost < best.cost) {
        best = *cheapest;
        best_axis = std::move(axis_planes);
      }
    }
    if (!best_axis) return;
    // A cell that no plane makes cheaper is a leaf.
    if (parted_by_ == PartedBy::space && best.cost >= static_cast<double>(boxes.size())) return;
    tally.nodes = 1;
    tally.between = AxisPlanes::meets(best, best_axis->low(), best_axis->high()) ? 1 : 0;
    tally.uneven = best.left != best.right ? 1 : 0;
    tally.crowd_is_smaller = tally.uneven == 1 && (best.left > best.right) == (best.left_area < best.right_area) ? 1 : 0;
    tally.crowd_is_denser = tally.uneven == 1 && (best.left > best.right) == (static_cast<double>(best.left) * best.right_area >
                                                                              static_cast<double>(best.right) * best.left_area)
                                ? 1
                                : 0;
    // A median that parts nothing leaves all of it in one.
    const auto whole = static_cast<double>(boxes.size());
    double* const sums[4] = {&tally.cost_between, &tally.cost_candidates, &tally.cost_spatial, &tally.cost_object};
    for (int i = 0; i < 4; ++i) *sums[i] = std::min(costs[i], whole) / best.cost;
    study_.levels[level].add(tally);
    study_.all.add(tally);
    descend(std::move(boxes), node, best_axis->axis, best, level + 1);
  }

  PlaneStudy take() { return std::move(study_); }

 private:
  void descend(std::vector<Box> boxes, const Box& node, int axis, const Plane& plane, unsigned level) {
    std::vector<Box> sides[2];
    if (parted_by_ == PartedBy::objects) {
      for (const Box& box : boxes) sides[centre_of(box, axis) <= plane.from ? 0 : 1].push_back(box);
      boxes = {};
      for (std::vector<Box>& side : sides) {
        Box bounds;
        for (const Box& box : side) bounds.grow(box);
        part(std::move(side), bounds, level);
      }
      return;
    }
    const auto position = static_cast<float>(plane.from);
    Box cells[2] = {node, node};
    cells[0].upper[axis] = position;
    cells[1].lower[axis] = position;
    for (const Box& box : boxes) {
      const bool is_below = box.lower[axis] < position || box.upper[axis] <= position;
      const bool is_above = box.upper[axis] > position;
      Box piece = box;
      piece.upper[axis] = std::min(box.upper[axis], position);
      if (is_below) sides[0].push_back(piece);
      piece = box;
      piece.lower[axis] = std::max(box.lower[axis], position);
      if (is_above) sides[1].push_back(piece);
    }
    boxes = {};
    for (int i = 0; i < 2; ++i) part(std::move(sides[i]), cells[i], level);
  }

  PartedBy parted_by_;
  std::size_t smallest_;
  PlaneStudy study_;
};

}  // namespace

void PlaneTally::add(const PlaneTally& other) {
  nodes += other.nodes;
  axes += other.axes;
  between_on_axis += other.between_on_axis;
  between += other.between;
  uneven += other.uneven;
  crowd_is_smaller += other.crowd_is_smaller;
  crowd_is_denser += other.crowd_is_denser;
  cost_between += other.cost_between;
  cost_candidates += other.cost_candidates;
  cost_spatial += other.cost_spatial;
  cost_object += other.cost_object;
}

PlaneStudy study_planes(const ReferenceList& list, PartedBy parted_by, unsigned levels, std::size_t smallest) {
  std::vector<Box> boxes;
  boxes.reserve(list.references.size());
  for (const PrimitiveReference& reference : list.references) boxes.push_back(reference.box().box());
  Study study(parted_by, levels, smallest);
  study.part(std::move(boxes), list.bounds, 0);
  return study.take();
}

}  // namespace grove
