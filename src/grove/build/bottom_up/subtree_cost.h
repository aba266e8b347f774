#pragma once

#include "grove/build/bottom_up/bottom_up_settings.h"
#include "grove/build/split.h"

namespace grove {

/// What tracing a subtree costs a ray, times its chance of meeting the subtree but for a common factor; and whether it had better be a leaf.
class SubtreeCost {
 public:
  SubtreeCost(const BottomUpSettings& settings, float area_scale)
      : leaf_size_(settings.leaf_size),
        traversal_(static_cast<float>(settings.cost.traversal)),
        intersection_(static_cast<float>(settings.cost.intersection)),
        area_scale_(area_scale) {}

  struct Decision {
    bool is_leaf;
    float cost;
  };

  [[nodiscard]] float of_reference(const Box4& box) const { return intersection_ * scaled_half_area(box, area_scale_); }

  /// Of two subtrees that together cost `inside` and hold `count` references in `box`.
  [[nodiscard]] Decision of_pair(const Box4& box, std::uint32_t count, float inside) const {
    const float area = scaled_half_area(box, area_scale_);
    const float cost = traversal_ * area + inside;
    const float leaf_cost = intersection_ * area * static_cast<float>(count);
    const bool is_leaf = count <= leaf_size_ && leaf_cost <= cost;
    return {is_leaf, is_leaf ? leaf_cost : cost};
  }

 private:
  std::uint32_t leaf_size_;
  float traversal_;
  float intersection_;
  float area_scale_;
};

}  // namespace grove
