#include "grove/build/passes/partial_rebuild.h"

#include <utility>

namespace grove {
namespace {

class Chooser {
 public:
  Chooser(const Bvh2& bvh, const SubtreeCosts& now, std::span<const float> built, const RebuildDecision& decision)
      : bvh_(bvh), now_(now), built_(built), decision_(decision) {}

  // Appends the best choice below and including `node` to `chosen` and returns what it saves, in steps.
  double choose(std::uint32_t node, std::vector<std::uint32_t>& chosen) const {
    const std::uint32_t references = now_.references[node];
    if (references < decision_.least_references) return 0.0;
    const std::size_t before = chosen.size();
    double below = 0.0;
    for (const Bvh2Node::Child& child : bvh_.nodes[node].child)
      if (child.count == 0) below += choose(child.first, chosen);
    const double chance = static_cast<double>(now_.area[node]) / static_cast<double>(now_.area[0]);
    const double excess = static_cast<double>(now_.per_entry[node]) - static_cast<double>(built_[node]);
    const double whole = decision_.rays * chance * excess - decision_.steps_per_reference * references;
    if (!(whole > below)) return below;
    chosen.resize(before);
    chosen.push_back(node);
    return whole;
  }

 private:
  const Bvh2& bvh_;
  const SubtreeCosts& now_;
  std::span<const float> built_;
  const RebuildDecision& decision_;
};

// Copies nodes and references in depth-first order.
class Splicer {
 public:
  Splicer(const Bvh2& bvh, std::span<const std::uint32_t> roots, std::span<const Bvh2> replacements)
      : bvh_(bvh), replacement_(bvh.nodes.size(), nullptr) {
    for (std::size_t k = 0; k < roots.size(); ++k) replacement_[roots[k]] = &replacements[k];
    result_.bvh.bounds = bvh.bounds;
    result_.bvh.nodes.reserve(bvh.nodes.size() + bvh.nodes.size() / 4);
    result_.bvh.references.reserve(bvh.references.size());
    result_.old_number.reserve(bvh.nodes.size() + bvh.nodes.size() / 4);
  }

  SplicedHierarchy run() {
    copy({0, 0}, 0);
    return std::move(result_);
  }

 private:
  Bvh2Node::Child copy(Bvh2Node::Child link, std::uint32_t depth) {
    if (link.count > 0) return copy_leaf(bvh_, link, depth);
    const Bvh2* const replacement = replacement_[link.first];
    if (replacement != nullptr && depth + replacement->depth <= Bvh2::kMaxDepth) return insert(*replacement, depth);
    const auto number = static_cast<std::uint32_t>(result_.bvh.nodes.size());
    result_.bvh.nodes.push_back(bvh_.nodes[link.first]);
    result_.old_number.push_back(link.first);
    for (int side = 0; side < 2; ++side) {
      const Bvh2Node::Child child = copy(bvh_.nodes[link.first].child[side], depth + 1);
      result_.bvh.nodes[number].child[side] = child;
    }
    return {number, 0};
  }

  Bvh2Node::Child copy_leaf(const Bvh2& source, Bvh2Node::Child link, std::uint32_t depth) {
    result_.bvh.depth = std::max(result_.bvh.depth, depth);
    const auto first = static_cast<std::uint32_t>(result_.bvh.references.size());
    const auto begin = source.references.begin() + link.first;
    result_.bvh.references.insert(result_.bvh.references.end(), begin, begin + link.count);
    return {first, link.count};
  }

  Bvh2Node::Child insert(const Bvh2& part, std::uint32_t depth) {
    result_.bvh.depth = std::max(result_.bvh.depth, depth + part.depth);
    const auto first_node = static_cast<std::uint32_t>(result_.bvh.nodes.size());
    const auto first_reference = static_cast<std::uint32_t>(result_.bvh.references.size());
    result_.bvh.references.insert(result_.bvh.references.end(), part.references.begin(), part.references.end());
    if (part.nodes.empty()) return {first_reference, static_cast<std::uint32_t>(part.references.size())};
    for (Bvh2Node node : part.nodes) {
      for (Bvh2Node::Child& child : node.child) child.first += child.count > 0 ? first_reference : first_node;
      result_.bvh.nodes.push_back(node);
      result_.old_number.push_back(SplicedHierarchy::kNewNode);
    }
    return {first_node, 0};
  }

  const Bvh2& bvh_;
  std::vector<const Bvh2*> replacement_;  // of each node
  SplicedHierarchy result_;
};

}  // namespace

std::vector<std::uint32_t> choose_rebuilds(const Bvh2& bvh, const SubtreeCosts& now, std::span<const float> built,
                                           const RebuildDecision& decision) {
  std::vector<std::uint32_t> chosen;
  if (!bvh.nodes.empty() && now.area[0] > 0.0F) Chooser(bvh, now, built, decision).choose(0, chosen);
  return chosen;
}

std::vector<std::uint32_t> primitives_below(const Bvh2& bvh, std::uint32_t node) {
  std::vector<std::uint32_t> primitives;
  std::vector<std::uint32_t> stack{node};
  while (!stack.empty()) {
    const Bvh2Node& top = bvh.nodes[stack.back()];
    stack.pop_back();
    for (const Bvh2Node::Child& child : top.child) {
      if (child.count == 0) {
        stack.push_back(child.first);
        continue;
      }
      const auto begin = bvh.references.begin() + child.first;
      primitives.insert(primitives.end(), begin, begin + child.count);
    }
  }
  std::sort(primitives.begin(), primitives.end());
  primitives.erase(std::unique(primitives.begin(), primitives.end()), primitives.end());
  return primitives;
}

SplicedHierarchy splice(const Bvh2& bvh, std::span<const std::uint32_t> roots, std::span<const Bvh2> replacements) {
  return Splicer(bvh, roots, replacements).run();
}

}  // namespace grove
