#pragma once

#include "grove/build/bottom_up/bottom_up_settings.h"
#include "grove/build/split.h"

namespace grove {

/// What tracing a subtree costs a ray, times its chance of meeting the subtree but for a common factor; and whether it had better be a leaf.
class SubtreeCost {
 public:
  SubtreeCost(const BottomUpSettings& settings, float area_scale)
      : leaf_size_(settings.leaf_size),
        cost_(settings.cost),
        traversal_(static_cast<float>(settings.cost.traversal)),
        intersection_(static_cast<float>(settings.cost.intersection)),
        area_scale_(area_scale) {}

  struct Decision {
    bool is_leaf;
    float cost;
  };

  [[nodiscard]] float of_reference(const Box4& box) const { return of_leaf(scaled_half_area(box, area_scale_), 1); }

  /// Of two subtrees that together cost `inside` and hold `count` references in `box`. What fits one block of several is a leaf.
  [[nodiscard]] Decision of_pair(const Box4& box, std::uint32_t count, float inside) const {
    const float area = scaled_half_area(box, area_scale_);
    const float cost = traversal_ * area + inside;
    const float leaf_cost = of_leaf(area, count);
    const bool is_leaf = count <= leaf_size_ && (leaf_cost <= cost || (cost_.block_size > 1 && count <= cost_.block_size));
    return {is_leaf, is_leaf ? leaf_cost : cost};
  }

 private:
  [[nodiscard]] float of_leaf(float area, std::uint32_t count) const {
    return intersection_ * area * static_cast<float>(cost_.in_whole_blocks(count));
  }

  std::uint32_t leaf_size_;
  CostModel cost_;
  float traversal_;
  float intersection_;
  float area_scale_;
};

}  // namespace grove
