#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace grove {

/// Draws an index in proportion to weights, in constant time (Walker 1977, built in linear time after Vose 1991). 8 bytes and the
/// probability an entry.
class AliasTable {
 public:
  struct Draw {
    std::uint32_t index = 0;
    float probability = 0.0F;
    float u = 0.0F;  ///< uniform again in [0, 1), for use within the entry
  };

  AliasTable() = default;
  /// Negative and non-finite weights count as 0. When all are 0 every entry is as likely.
  explicit AliasTable(std::span<const float> weights);

  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  /// The chance of `draw` giving this index; they sum to 1.
  [[nodiscard]] float probability(std::uint32_t index) const { return probability_[index]; }
  /// `u` in [0, 1). The table must not be empty.
  [[nodiscard]] Draw draw(float u) const;

 private:
  struct Entry {
    float keep;  // of the entry's share, the part that is its own
    std::uint32_t alias;
  };
  std::vector<Entry> entries_;
  std::vector<float> probability_;
};

}  // namespace grove
