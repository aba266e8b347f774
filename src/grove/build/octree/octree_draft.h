#pragma once

// What tasks build before it is known where things go in an octree: nodes that name their eight octants freely, and leaves that lie anywhere.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "grove/math/vector.h"

namespace grove {

/// What an octant of a draft is, in one word.
class DraftSlot {
 public:
  enum class Kind : std::uint8_t { empty, node, leaf, part, kept };

  DraftSlot() = default;
  [[nodiscard]] static DraftSlot node(std::size_t number) { return DraftSlot(number, Kind::node); }
  [[nodiscard]] static DraftSlot leaf(std::size_t number) { return DraftSlot(number, Kind::leaf); }
  /// What the part of this number has as its root.
  [[nodiscard]] static DraftSlot part(std::size_t number) { return DraftSlot(number, Kind::part); }

  /// A node of the octree that is being updated, with all below it.
  [[nodiscard]] static DraftSlot kept(std::size_t number) { return DraftSlot(number, Kind::kept); }

  [[nodiscard]] Kind kind() const { return static_cast<Kind>(word_ & 7U); }
  [[nodiscard]] std::uint32_t number() const { return word_ >> 3U; }
  /// Numbers are smaller.
  static constexpr std::size_t kMostNumbers = std::size_t{1} << 29U;

 private:
  DraftSlot(std::size_t number, Kind kind) : word_(static_cast<std::uint32_t>(number) << 3U | static_cast<std::uint32_t>(kind)) {}

  std::uint32_t word_ = 0;
};

/// The primitives of a leaf, or of a node itself, in a draft's list; ascending.
struct DraftLeaf {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

struct DraftNode {
  Vec3 planes;
  std::uint8_t cut_axes = 0;
  /// How many primitives the cell's set had, before it was parted.
  std::uint32_t count = 0;
  DraftLeaf own;
  std::array<DraftSlot, 8> octants;
};

/// A subtree. Its numbers are its own; those of parts are places in `parts`. Each node, leaf and part but the root is named by one octant.
struct OctreeDraft {
  std::vector<DraftNode> nodes;
  std::vector<DraftLeaf> leaves;
  std::vector<std::uint32_t> references;
  std::vector<std::unique_ptr<OctreeDraft>> parts;
  DraftSlot root;

  DraftSlot add_leaf(std::span<const std::uint32_t> ids) {
    leaves.push_back(add(ids));
    return DraftSlot::leaf(leaves.size() - 1);
  }
  /// A node without octants yet. `count` as in DraftNode.
  DraftSlot add_node(const Vec3& planes, std::uint32_t cut_axes, std::size_t count, std::span<const std::uint32_t> own) {
    nodes.push_back({planes, static_cast<std::uint8_t>(cut_axes), static_cast<std::uint32_t>(count), add(own), {}});
    return DraftSlot::node(nodes.size() - 1);
  }
  [[nodiscard]] std::span<const std::uint32_t> ids_of(const DraftLeaf& leaf) const { return {references.data() + leaf.first, leaf.count}; }
  [[nodiscard]] std::span<const std::uint32_t> ids_of_leaf(DraftSlot slot) const { return ids_of(leaves[slot.number()]); }

  /// How much there is, so that what is added after it can be taken back.
  struct Mark {
    std::size_t nodes, leaves, references;
  };
  [[nodiscard]] Mark mark() const { return {nodes.size(), leaves.size(), references.size()}; }
  void take_back(const Mark& before) {
    nodes.resize(before.nodes);
    leaves.resize(before.leaves);
    references.resize(before.references);
  }

  /// The draft, and the slot in it, that a slot stands for once parts are followed.
  struct Place {
    const OctreeDraft* draft;
    DraftSlot slot;
  };
  [[nodiscard]] Place resolve(DraftSlot slot) const {
    const OctreeDraft* draft = this;
    while (slot.kind() == DraftSlot::Kind::part) {
      draft = draft->parts[slot.number()].get();
      slot = draft->root;
    }
    return {draft, slot};
  }

 private:
  DraftLeaf add(std::span<const std::uint32_t> ids) {
    const auto first = static_cast<std::uint32_t>(references.size());
    references.insert(references.end(), ids.begin(), ids.end());
    return {first, static_cast<std::uint32_t>(ids.size())};
  }
};

}  // namespace grove
