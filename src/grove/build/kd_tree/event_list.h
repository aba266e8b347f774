#pragma once

// Where references begin and end along an axis, in order: what the exact sweep goes over, and how the order is kept when a set is parted, without
// sorting again (Wald and Havran 2006, section 4.3).

#include <bit>
#include <cstdint>
#include <span>

#include "grove/build/kd_tree/part_references.h"

namespace grove {

/// A reference begins, ends, or lies flat in a plane. One number, ordered by position, then kind, then reference:
/// 32 bits of position (a float made comparable), 2 of kind, 30 of reference.
class KdEvent {
 public:
  /// In the order in which events of one position are passed.
  enum class Kind : std::uint8_t { end, flat, begin };

  KdEvent() = default;
  KdEvent(float position, Kind kind, std::uint32_t reference)
      : key_(static_cast<std::uint64_t>(ordered(position)) << 32U | static_cast<std::uint64_t>(kind) << 30U | reference) {}

  [[nodiscard]] float position() const {
    const auto bits = static_cast<std::uint32_t>(key_ >> 32U);
    return std::bit_cast<float>((bits & kSign) != 0 ? bits & ~kSign : ~bits);
  }
  [[nodiscard]] bool is_at_position_of(KdEvent other) const { return (key_ >> 32U) == (other.key_ >> 32U); }
  [[nodiscard]] Kind kind() const { return static_cast<Kind>(key_ >> 30U & 3U); }
  [[nodiscard]] std::uint32_t reference() const { return static_cast<std::uint32_t>(key_) & kReferenceMask; }
  [[nodiscard]] KdEvent renumbered(std::uint32_t reference) const {
    KdEvent event = *this;
    event.key_ = (key_ & ~std::uint64_t{kReferenceMask}) | reference;
    return event;
  }

  friend bool operator<(KdEvent a, KdEvent b) { return a.key_ < b.key_; }
  friend bool operator==(KdEvent a, KdEvent b) { return a.key_ == b.key_; }

 private:
  static constexpr std::uint32_t kSign = 0x80000000U;
  static constexpr std::uint32_t kReferenceMask = (1U << 30U) - 1;
  // Adding 0 turns -0 into 0, so that one position has one number.
  static std::uint32_t ordered(float position) {
    const auto bits = std::bit_cast<std::uint32_t>(position + 0.0F);
    return (bits & kSign) != 0 ? ~bits : bits | kSign;
  }

  std::uint64_t key_;
};

static_assert(sizeof(KdEvent) == 8);

using KdEvents = HugeVector<KdEvent>;

/// The events of references [first, end) along all axes, sorted. O(n log n), in parallel for many.
void list_events(const References& references, std::size_t first, KdEvents events[3]);

/// What keeping the order uses, kept from one cell to the next.
struct EventScratch {
  KdEvents of_pieces[2][3];
};

/// Parts the events of a set as its references have been parted: `sides[s]` are those references, `parted[s]` become their events. O(events), and sorting
/// for those of pieces; in parallel for many. The same for any number of threads.
void part_events(const KdEvents events[3], const KdPlaces& places, const References* const sides[2], KdEvents* const parted[2],
                 EventScratch& scratch);

}  // namespace grove
