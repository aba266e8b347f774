#include "grove/build/cost_model.h"

#include <cmath>
#include <limits>

#include "grove/accel/bvh2.h"
#include "grove/accel/fast_bvh.h"
#include "grove/accel/kd_tree.h"
#include "grove/accel/octree.h"
#include "grove/accel/volume_bvh.h"
#include "grove/accel/wide_bvh.h"

namespace grove {

AreaMeasure::AreaMeasure(const Box& scene) {
  if (scene.is_empty()) return;
  const float side = scene.extent()[scene.longest_axis()];
  if (!(side > 0.0F)) return;
  const float inverse = 1.0F / side;
  scale_ = std::isinf(inverse) ? std::numeric_limits<float>::max() : inverse;
}

double AreaMeasure::half_area(const Box& box) const {
  if (box.is_empty()) return 0.0;
  const glm::dvec3 d = (glm::dvec3(box.upper) - glm::dvec3(box.lower)) * static_cast<double>(scale_);
  return d.x * (d.y + d.z) + d.y * d.z;
}

namespace {

template <typename Hierarchy>
double cost_of(const Hierarchy& hierarchy, const CostModel& model) {
  const AreaMeasure measure(hierarchy.bounds);
  const double root_area = measure.half_area(hierarchy.bounds);
  double sum = 0.0;
  hierarchy.visit([&](const Box& box, std::uint32_t /*depth*/, std::uint32_t /*first*/, std::uint32_t count) {
    // A scene without area (all in one point or on one line) is met by every ray that meets its root.
    const double probability = root_area > 0.0 ? measure.half_area(box) / root_area : 1.0;
    sum += probability * (count > 0 ? model.intersection * count : model.traversal);
  });
  return sum;
}

}  // namespace

double expected_cost(const Bvh2& bvh, const CostModel& model) {
  return cost_of(bvh, model);
}

template <int kWidth>
double expected_cost(const WideBvh<kWidth>& bvh, const CostModel& model) {
  return cost_of(bvh, model);
}

template <typename Node, typename Block>
double expected_cost(const BasicFastBvh<Node, Block>& bvh, const CostModel& model) {
  return cost_of(bvh, model);
}
template double expected_cost(const FastBvh& bvh, const CostModel& model);
template double expected_cost(const CompressedFastBvh& bvh, const CostModel& model);

double expected_cost(const KdTree& tree, const CostModel& model) {
  const AreaMeasure measure(tree.bounds);
  const double root_area = measure.half_area(tree.bounds);
  double sum = 0.0;
  tree.visit([&](const Box& cell, std::uint32_t /*depth*/, const KdNode& node) {
    const double probability = root_area > 0.0 ? measure.half_area(cell) / root_area : 1.0;
    sum += probability * (node.is_leaf() ? model.intersection * node.count() : model.traversal);
  });
  return sum;
}

double expected_cost(const Octree& tree, const CostModel& model) {
  const AreaMeasure measure(tree.bounds);
  const double root_area = measure.half_area(tree.bounds);
  double sum = 0.0;
  tree.visit([&](const Octree::Visited& visited) {
    const double probability = root_area > 0.0 ? measure.half_area(visited.cell.intersection(tree.bounds)) / root_area : 1.0;
    sum += probability * (visited.is_leaf ? model.intersection * visited.count : model.traversal);
  });
  return sum;
}

template <BoundingVolume V>
double expected_cost(const VolumeBvh<V>& bvh, const CostModel& model) {
  if (bvh.nodes.empty()) return 0.0;
  const double root_area = bvh.nodes[0].volume.half_area();
  double sum = 0.0;
  bvh.visit_nodes([&](const VolumeNode<V>& node, std::uint32_t /*depth*/) {
    const double probability = root_area > 0.0 ? node.volume.half_area() / root_area : 1.0;
    sum += probability * (node.is_leaf ? model.intersection * node.count : model.traversal);
  });
  return sum;
}

template double expected_cost(const WideBvh<4>& bvh, const CostModel& model);
template double expected_cost(const WideBvh<8>& bvh, const CostModel& model);
template double expected_cost(const VolumeBvh<OrientedBox>& bvh, const CostModel& model);
template double expected_cost(const VolumeBvh<BoundingSphere>& bvh, const CostModel& model);

}  // namespace grove
