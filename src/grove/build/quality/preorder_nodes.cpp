#include "grove/build/quality/preorder_nodes.h"

#include <algorithm>
#include <utility>

namespace grove {

// Ends the subtrees of the open nodes from `depth` on.
void PreorderNodes::close(std::vector<std::uint32_t>& open, std::size_t depth) {
  while (open.size() > depth) {
    Node& node = nodes_[open.back()];
    node.end = static_cast<std::uint32_t>(nodes_.size());
    node.reference_count = static_cast<std::uint32_t>(references_.size()) - node.first_reference;
    open.pop_back();
  }
}

// A counting sort of the references by primitive.
void PreorderNodes::index_primitives(std::size_t primitive_count) {
  first_place_.assign(primitive_count + 1, 0);
  for (const std::uint32_t primitive : references_) ++first_place_[primitive];
  std::uint32_t total = 0;
  for (std::uint32_t& first : first_place_) total += std::exchange(first, total);
  places_.resize(references_.size());
  // Each first place moves on to its end, which is where the next primitive's is.
  for (std::uint32_t i = 0; i < references_.size(); ++i) places_[first_place_[references_[i]]++] = i;
  std::copy_backward(first_place_.begin(), first_place_.end() - 1, first_place_.end());
  first_place_[0] = 0;
}

std::size_t PreorderNodes::referenced_primitive_count() const {
  std::size_t count = 0;
  for (std::size_t i = 0; i + 1 < first_place_.size(); ++i) count += first_place_[i] < first_place_[i + 1] ? 1 : 0;
  return count;
}

std::optional<double> PreorderNodes::duplication() const {
  if (references_.empty()) return std::nullopt;
  return static_cast<double>(references_.size()) / static_cast<double>(referenced_primitive_count());
}

bool PreorderNodes::holds(const Node& node, std::uint32_t primitive) const {
  const std::uint32_t* const last = places_.data() + first_place_[primitive + 1];
  const std::uint32_t* const place = std::lower_bound(places_.data() + first_place_[primitive], last, node.first_reference);
  return place != last && *place < node.first_reference + node.reference_count;
}

}  // namespace grove
