#include "grove/lab/split_costs.h"

#include <fmt/format.h>

#include <algorithm>

#include "grove/build/primitive_reference.h"
#include "grove/build/split.h"
#include "grove/lab/largest_object.h"

namespace grove {
namespace {

SplitCostCurve curve_on(const ReferenceList& list, int axis, unsigned plane_count) {
  std::vector<std::pair<double, Box>> order;
  for (const PrimitiveReference& reference : list.references)
    order.emplace_back(0.5 * static_cast<double>(static_cast<float>(reference.doubled_centre()[axis])), reference.box().box());
  std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });

  const AreaMeasure measure(list.bounds);
  const double whole = measure.half_area(list.bounds);
  const CostModel model;
  const SubsetTime tests(model);
  const SubsetTime with_subtree(CostModel{model.traversal, model.intersection, SplitCost::equation_2});

  std::vector<double> area_from(order.size() + 1, 0.0);
  Box box;
  for (std::size_t i = order.size(); i-- > 0;) {
    box.grow(order[i].second);
    area_from[i] = measure.half_area(box);
  }
  SplitCostCurve curve;
  curve.axis = axis;
  curve.spatial_median = 0.5 * (static_cast<double>(list.bounds.lower[axis]) + list.bounds.upper[axis]);
  curve.object_median = order[order.size() / 2].first;
  Box left;
  std::size_t next = 0;
  for (unsigned i = 1; i <= plane_count; ++i) {
    const double share = static_cast<double>(i) / (plane_count + 1);
    const double position = list.bounds.lower[axis] + share * (static_cast<double>(list.bounds.upper[axis]) - list.bounds.lower[axis]);
    for (; next < order.size() && order[next].first < position; ++next) left.grow(order[next].second);
    if (next == 0 || next == order.size() || !(whole > 0.0)) continue;
    SplitCost1D cost{position, next, order.size() - next};
    const double left_chance = measure.half_area(left) / whole;
    const double right_chance = area_from[next] / whole;
    const auto left_count = static_cast<std::uint32_t>(cost.left);
    const auto right_count = static_cast<std::uint32_t>(cost.right);
    cost.standard = model.traversal + left_chance * tests(left_count) + right_chance * tests(right_count);
    cost.equation_2 = left_chance * with_subtree(left_count) + right_chance * with_subtree(right_count);
    curve.planes.push_back(cost);
  }
  return curve;
}

}  // namespace

std::vector<SplitCostCurve> split_cost_curves(const Scene& scene, unsigned plane_count) {
  std::vector<SplitCostCurve> curves;
  const Object* const largest = largest_object(scene);
  if (largest == nullptr) return curves;
  const ReferenceList list = std::visit([](const auto& set) { return list_references(*set); }, largest->geometry);
  if (list.references.empty()) return curves;
  for (int axis = 0; axis < 3; ++axis) curves.push_back(curve_on(list, axis, plane_count));
  return curves;
}

std::string split_costs_csv(const std::vector<SplitCostCurve>& curves) {
  std::string text = "axis,position,left,right,standard,equation_2,spatial_median,object_median\n";
  for (const SplitCostCurve& curve : curves) {
    for (const SplitCost1D& plane : curve.planes) {
      text += fmt::format("{},{},{},{},{},{},{},{}\n", "xyz"[curve.axis], plane.position, plane.left, plane.right, plane.standard,
                          plane.equation_2, curve.spatial_median, curve.object_median);
    }
  }
  return text;
}

}  // namespace grove
