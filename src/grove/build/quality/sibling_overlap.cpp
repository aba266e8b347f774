#include "grove/build/quality/sibling_overlap.h"

#include "grove/build/cost_model.h"

namespace grove {

double sibling_overlap(const PreorderNodes& hierarchy) {
  const std::span<const PreorderNodes::Node> nodes = hierarchy.nodes();
  if (nodes.empty()) return 0.0;
  const AreaMeasure measure(nodes[0].box);
  double whole = 0.0;
  double common = 0.0;
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    if (hierarchy.is_leaf(i)) continue;
    whole += measure.half_area(nodes[i].box);
    for (std::uint32_t a = i + 1; a < nodes[i].end; a = nodes[a].end)
      for (std::uint32_t b = nodes[a].end; b < nodes[i].end; b = nodes[b].end)
        common += measure.half_area(nodes[a].box.intersection(nodes[b].box));
  }
  return whole > 0.0 ? common / whole : 0.0;
}

}  // namespace grove
