#include "grove/build/passes/subtree_costs.h"

#include "grove/base/parallel.h"
#include "grove/build/passes/refit.h"

namespace grove {
namespace {

class Measurer {
 public:
  Measurer(const Bvh2& bvh, const CostModel& cost, SubtreeCosts& costs)
      : bvh_(bvh), cost_(cost), costs_(costs), scale_(AreaMeasure(bvh.bounds).scale()) {}

  struct Subtree {
    double cost;  // times area
    std::uint32_t references;
  };

  Subtree measure(std::uint32_t number, const Box& box, std::uint32_t depth) {
    const Bvh2Node& node = bvh_.nodes[number];
    Subtree sides[2];
    const auto descend = [&](int i) {
      const Bvh2Node::Child link = node.child[i];
      const Box child_box = node.child_box(i);
      sides[i] = link.count > 0 ? Subtree{cost_.intersection * link.count * static_cast<double>(area(child_box)), link.count}
                                : measure(link.first, child_box, depth + 1);
    };
    if (depth < kUpdateTaskDepth) {
      parallel_invoke([&] { descend(0); }, [&] { descend(1); });
    } else {
      descend(0);
      descend(1);
    }
    const float own_area = area(box);
    const Subtree whole{cost_.traversal * static_cast<double>(own_area) + sides[0].cost + sides[1].cost,
                        sides[0].references + sides[1].references};
    costs_.area[number] = own_area;
    costs_.references[number] = whole.references;
    costs_.per_entry[number] = own_area > 0.0F ? static_cast<float>(whole.cost / static_cast<double>(own_area)) : 0.0F;
    return whole;
  }

 private:
  [[nodiscard]] float area(const Box& box) const { return scaled_half_area({to_float4(box.lower), to_float4(box.upper)}, scale_); }

  const Bvh2& bvh_;
  const CostModel& cost_;
  SubtreeCosts& costs_;
  float scale_;
};

}  // namespace

SubtreeCosts measure_subtree_costs(const Bvh2& bvh, const CostModel& cost) {
  SubtreeCosts costs;
  if (!bvh.nodes.empty()) {
    costs.per_entry.resize(bvh.nodes.size());
    costs.area.resize(bvh.nodes.size());
    costs.references.resize(bvh.nodes.size());
    Measurer(bvh, cost, costs).measure(0, bvh.bounds, 0);
  }
  const bool has_area = !bvh.nodes.empty() && costs.area[0] > 0.0F;
  costs.total = has_area ? static_cast<double>(costs.per_entry[0]) : expected_cost(bvh, cost);
  return costs;
}

}  // namespace grove
