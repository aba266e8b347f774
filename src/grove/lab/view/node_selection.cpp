#include "grove/lab/view/node_selection.h"

#include <algorithm>

namespace grove {
namespace {

constexpr std::uint32_t kMostStride = 32;

/// Marks what the rays come to and all above. Returns how many nodes that is.
std::size_t mark_nodes(const ViewTree& tree, const std::vector<RecordedRay>& recorded, std::span<const std::uint32_t> rays,
                       std::vector<bool>& is_marked) {
  std::size_t count = 0;
  is_marked.assign(tree.nodes().size(), false);
  for (const std::uint32_t ray : rays) {
    for (const PlacedStep& step : recorded[ray].steps) {
      if (step.kind == TraversalStep::Kind::test) continue;
      for (std::uint32_t place = step.place; place != ViewNode::kNone && !is_marked[place]; place = tree.nodes()[place].parent) {
        is_marked[place] = true;
        ++count;
      }
    }
  }
  return count;
}

std::size_t count_steps(const std::vector<RecordedRay>& recorded, std::span<const std::uint32_t> rays) {
  std::size_t count = 0;
  for (const std::uint32_t ray : rays) count += recorded[ray].steps.size();
  return count;
}

}  // namespace

std::vector<std::uint32_t> recorded_of_stride(std::uint32_t stride) {
  const std::vector<std::uint32_t> all = PictureRays::pixels(PictureRays::kLeastStride);
  const std::vector<std::uint32_t> some = PictureRays::pixels(stride);
  std::vector<std::uint32_t> rays;
  rays.reserve(some.size());
  // Both ascend.
  for (std::uint32_t i = 0; i < all.size() && rays.size() < some.size(); ++i)
    if (all[i] == some[rays.size()]) rays.push_back(i);
  return rays;
}

NodeSelection select_nodes(const ViewTree& tree, const std::vector<RecordedRay>& recorded, const ViewLimits& limits) {
  NodeSelection selection;
  std::vector<bool> is_in;
  std::size_t count = 0;
  for (selection.stride = PictureRays::kLeastStride;; selection.stride *= 2) {
    const std::vector<std::uint32_t> rays = recorded_of_stride(selection.stride);
    count = mark_nodes(tree, recorded, rays, is_in);
    const bool fits = count <= limits.most_nodes / 4 * 3 && count_steps(recorded, rays) <= limits.most_steps;
    if (fits || selection.stride == kMostStride) break;
  }

  std::vector<std::size_t> left_out;  // by level
  for (std::size_t i = 0; i < tree.nodes().size(); ++i) {
    const std::uint32_t depth = tree.nodes()[i].depth;
    if (depth >= left_out.size()) left_out.resize(std::size_t{depth} + 1);
    if (!is_in[i]) ++left_out[depth];
  }
  std::size_t level = 0;
  for (; level < left_out.size() && count + left_out[level] <= limits.most_nodes; ++level) count += left_out[level];
  selection.complete_depth = static_cast<std::uint32_t>(std::max<std::size_t>(level, 1) - 1);

  selection.index.assign(tree.nodes().size(), ViewNode::kNone);
  selection.places.reserve(count);
  for (std::uint32_t i = 0; i < tree.nodes().size(); ++i) {
    if (!is_in[i] && tree.nodes()[i].depth > selection.complete_depth) continue;
    selection.index[i] = static_cast<std::uint32_t>(selection.places.size());
    selection.places.push_back(i);
  }
  return selection;
}

}  // namespace grove
