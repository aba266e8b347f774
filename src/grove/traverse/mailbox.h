#pragma once

#include <algorithm>
#include <cstdint>

#include "grove/geometry/hit.h"

namespace grove {

/// Remembers primitives that a ray has been tested against, so that one that lies in several cells is tested once (Amanatides and Woo 1987). Instead of
/// a mark at each primitive, which threads could not share, the ray keeps its last few tests in one cache line (Shevtsov, Soupikov and Kapustin 2007:
/// inverse mailboxing). Forgetting one costs a test, never a hit: a test that is repeated changes nothing.
class Mailbox {
 public:
  Mailbox() { std::fill_n(tested_, kSize, kInvalidId); }

  /// Whether `primitive` is known to have been tested; from now on it is.
  bool remembers(std::uint32_t primitive) {
    std::uint32_t& place = tested_[primitive % kSize];
    if (place == primitive) return true;
    place = primitive;
    return false;
  }

 private:
  static constexpr std::uint32_t kSize = 16;
  alignas(64) std::uint32_t tested_[kSize];
};

/// The mailbox that remembers nothing.
struct NoMailbox {
  static bool remembers(std::uint32_t /*primitive*/) { return false; }
};

}  // namespace grove
