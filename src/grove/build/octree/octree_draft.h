#pragma once

// What tasks build before it is known where things go in an octree: nodes that name their eight octants freely, and leaves that lie anywhere.

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "grove/math/vector.h"

namespace grove {

/// What an octant of a draft is, in one word.
class DraftSlot {
 public:
  enum class Kind : std::uint8_t { empty, node, leaf, part };

  DraftSlot() = default;
  [[nodiscard]] static DraftSlot node(std::size_t number) { return DraftSlot(number, Kind::node); }
  [[nodiscard]] static DraftSlot leaf(std::size_t number) { return DraftSlot(number, Kind::leaf); }
  /// What the part of this number has as its root.
  [[nodiscard]] static DraftSlot part(std::size_t number) { return DraftSlot(number, Kind::part); }

  [[nodiscard]] Kind kind() const { return static_cast<Kind>(word_ & 3U); }
  [[nodiscard]] std::uint32_t number() const { return word_ >> 2U; }

 private:
  DraftSlot(std::size_t number, Kind kind) : word_(static_cast<std::uint32_t>(number) << 2U | static_cast<std::uint32_t>(kind)) {}

  std::uint32_t word_ = 0;
};

/// References of a leaf, or of a node itself, in a draft's list.
struct DraftLeaf {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

struct DraftNode {
  Vec3 planes;
  std::uint8_t cut_axes = 0;
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
};

}  // namespace grove
