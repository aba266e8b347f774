#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "grove/lab/view/structure_sample.h"
#include "grove/lab/view/view_tree.h"

namespace grove {

/// How much of a structure fits into a page.
struct ViewLimits {
  std::size_t most_nodes = 60'000;
  std::size_t most_steps = 1'200'000;  ///< of recorded rays, all together
};

/// The nodes of a structure that a page shows: the upper levels whole, and of those below what recorded rays come to, with all that is above.
struct NodeSelection {
  std::vector<std::uint32_t> places;  ///< in ViewTree::nodes(), ascending
  std::vector<std::uint32_t> index;   ///< of each node of the tree in `places`, or ViewNode::kNone
  std::uint32_t complete_depth = 0;   ///< the deepest level of which, as of all above it, every node is there
  std::uint32_t stride = 0;           ///< of the recorded rays that are kept (PictureRays::pixels)
};

/// Keeps as many recorded rays as fit into three quarters of the nodes, and then as many levels as fit into the rest.
[[nodiscard]] NodeSelection select_nodes(const ViewTree& tree, const std::vector<RecordedRay>& recorded, const ViewLimits& limits);

/// Those of the rays of PictureRays::pixels(kLeastStride) that are rays of a coarser stride.
[[nodiscard]] std::vector<std::uint32_t> recorded_of_stride(std::uint32_t stride);

}  // namespace grove
