#include "grove/build/kd_tree/build_kd_tree.h"

#include <cmath>

#include "grove/build/kd_tree/binned_planes.h"
#include "grove/build/kd_tree/exact_planes.h"
#include "grove/build/kd_tree/kd_tree_driver.h"
#include "grove/build/kd_tree/median_planes.h"

namespace grove {
namespace {

template <KdPlaneFinder P>
KdTreePart drive(References references, const KdCell& cell, const P& finder, const KdBuildContext& context) {
  const detail::KdBuilder<P> builder(finder, context.settings, context.most_depth);
  return builder.build(finder.make_set(std::move(references)), cell);
}

}  // namespace

std::uint32_t most_depth(const KdTreeSettings& settings, std::size_t primitive_count) {
  const auto automatic = static_cast<std::uint32_t>(8.5 + 1.3 * std::log2(static_cast<double>(primitive_count)));
  return std::min(settings.most_depth > 0 ? settings.most_depth : automatic, KdTree::kMaxDepth);
}

KdTreePart build_kd_tree_part(References references, const KdCell& cell, const KdBuildContext& context) {
  const KdCostContext costs = context.costs();
  const ReferenceClipper& clipper = context.clipper;
  switch (context.settings.split) {
    case KdSplit::sah:
      return drive(std::move(references), cell, ExactPlanes(costs, clipper), context);
    case KdSplit::object_median:
      return drive(std::move(references), cell, MedianPlanes(MedianPlanes::Of::objects, costs, clipper), context);
    case KdSplit::spatial_median:
      return drive(std::move(references), cell, MedianPlanes(MedianPlanes::Of::space, costs, clipper), context);
    case KdSplit::binned:
      break;
  }
  return drive(std::move(references), cell, BinnedPlanes(costs, clipper), context);
}

KdTree build_kd_tree(ReferenceList list, const ReferenceClipper& clipper, const KdTreeSettings& settings) {
  if (list.references.empty()) return {};
  const std::size_t size = list.references.size();
  const KdBuildContext context{clipper, settings, AreaMeasure(list.bounds).scale(), most_depth(settings, size)};
  const auto capacity = static_cast<std::uint64_t>(settings.most_references * static_cast<double>(size));
  const KdCell root{{to_float4(list.bounds.lower), to_float4(list.bounds.upper)}, 0, 0, capacity};
  return assemble(build_kd_tree_part(std::move(list.references), root, context), list.bounds);
}

}  // namespace grove
