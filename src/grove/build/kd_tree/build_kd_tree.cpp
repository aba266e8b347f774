#include "grove/build/kd_tree/build_kd_tree.h"

#include <cmath>

#include "grove/build/kd_tree/binned_planes.h"
#include "grove/build/kd_tree/exact_planes.h"
#include "grove/build/kd_tree/kd_tree_driver.h"
#include "grove/build/kd_tree/median_planes.h"

namespace grove {
namespace {

std::uint32_t most_depth(const KdTreeSettings& settings, std::size_t size) {
  const auto automatic = static_cast<std::uint32_t>(8.5 + 1.3 * std::log2(static_cast<double>(size)));
  return std::min(settings.most_depth > 0 ? settings.most_depth : automatic, KdTree::kMaxDepth);
}

template <KdPlaneFinder P>
KdTree drive(ReferenceList list, const P& finder, const KdTreeSettings& settings) {
  const std::size_t size = list.references.size();
  const detail::KdCell root{{to_float4(list.bounds.lower), to_float4(list.bounds.upper)},
                            0,
                            0,
                            static_cast<std::uint64_t>(settings.most_references * static_cast<double>(size))};
  const detail::KdBuilder<P> builder(finder, settings, most_depth(settings, size));
  return assemble(builder.build(finder.make_set(std::move(list.references)), root), list.bounds);
}

}  // namespace

KdTree build_kd_tree(ReferenceList list, const ReferenceClipper& clipper, const KdTreeSettings& settings) {
  if (list.references.empty()) return {};
  const KdCostContext costs{AreaMeasure(list.bounds).scale(), settings.cost, settings.empty_bonus};
  switch (settings.split) {
    case KdSplit::sah:
      return drive(std::move(list), ExactPlanes(costs, clipper), settings);
    case KdSplit::object_median:
      return drive(std::move(list), MedianPlanes(MedianPlanes::Of::objects, costs, clipper), settings);
    case KdSplit::spatial_median:
      return drive(std::move(list), MedianPlanes(MedianPlanes::Of::space, costs, clipper), settings);
    case KdSplit::binned:
      break;
  }
  return drive(std::move(list), BinnedPlanes(costs, clipper), settings);
}

}  // namespace grove
