#include "grove/build/octree/changed_octree.h"

#include <algorithm>

#include "grove/base/parallel.h"
#include "grove/build/split.h"

namespace grove {

ChangedOctree::ChangedOctree(const Octree& tree, const std::vector<bool>& is_removed, std::uint32_t largest_leaf)
    : tree_(tree), is_removed_(is_removed), largest_leaf_(largest_leaf), removed_before_(std::size_t{tree.leaf_count()} + 1, 0) {
  parallel_ranges(tree.leaf_count(), kBuildChunkSize, [&](std::size_t first, std::size_t last) {
    for (std::size_t leaf = first; leaf < last; ++leaf)
      for (std::uint32_t i = tree.leaf_first[leaf]; i < tree.leaf_first[leaf + 1]; ++i)
        removed_before_[leaf + 1] += is_removed[tree.references[i]] ? 1 : 0;
  });
  for (std::size_t leaf = 0; leaf < tree.leaf_count(); ++leaf) removed_before_[leaf + 1] += removed_before_[leaf];
}

std::size_t ChangedOctree::primitive_count(std::uint32_t number) const {
  const std::size_t references = reference_count(number);
  const std::size_t most = std::size_t{largest_leaf_} + 1;
  if (is_kept(number)) return std::max(references, most);
  std::vector<std::uint32_t> found;
  const Octree::Below below = tree_.below(number);
  for (std::uint32_t i = tree_.leaf_first[below.first_leaf]; i < tree_.leaf_first[below.end_leaf] && found.size() < most; ++i) {
    const std::uint32_t id = tree_.references[i];
    if (!is_removed_[id] && std::find(found.begin(), found.end(), id) == found.end()) found.push_back(id);
  }
  return found.size() < most ? found.size() : std::max(references, most);
}

void ChangedOctree::append(std::uint32_t first_leaf, std::uint32_t end_leaf, std::vector<std::uint32_t>& ids) const {
  for (std::uint32_t i = tree_.leaf_first[first_leaf]; i < tree_.leaf_first[end_leaf]; ++i)
    if (!is_removed_[tree_.references[i]]) ids.push_back(tree_.references[i]);
}

}  // namespace grove
