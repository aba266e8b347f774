#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

#include "grove/base/huge_vector.h"

namespace grove {

/// Writes the leaves of a collapsed hierarchy one after another. A leaf that comes to hold several pieces of a primitive names it once.
class LeafWriter {
 public:
  LeafWriter(const HugeVector<std::uint32_t>& source, HugeVector<std::uint32_t>& target) : source_(source), target_(target) {
    target_.reserve(source.size());
  }

  /// Returns the place and the size of the leaf made of source references [first, first + count).
  std::pair<std::uint32_t, std::uint32_t> write(std::uint32_t first, std::uint32_t count) {
    const auto begin = static_cast<std::uint32_t>(target_.size());
    for (std::uint32_t i = first; i < first + count; ++i) {
      const auto leaf = target_.begin() + begin;
      if (std::find(leaf, target_.end(), source_[i]) == target_.end()) target_.push_back(source_[i]);
    }
    return {begin, static_cast<std::uint32_t>(target_.size()) - begin};
  }

 private:
  const HugeVector<std::uint32_t>& source_;
  HugeVector<std::uint32_t>& target_;
};

}  // namespace grove
