#pragma once

#include <cstddef>
#include <cstdint>

namespace grove {

/// The step of addresses in the hierarchies of the fast path: nodes and blocks of triangles begin at multiples of it.
struct alignas(32) FastUnit {
  std::byte bytes[32];
};

/// What a child of a node is, in one word: a node or a block of triangles, and where it lies in the memory of the hierarchy. So a kernel finds
/// both by the same arithmetic. `kUnits` is the size of a node.
template <std::uint32_t kUnits>
class BasicFastChild {
 public:
  BasicFastChild() = default;

  [[nodiscard]] static BasicFastChild node(std::uint32_t number) { return BasicFastChild(number * kUnits); }
  /// The block that begins at a unit.
  [[nodiscard]] static BasicFastChild leaf(std::uint32_t unit) { return BasicFastChild(kLeaf | unit); }

  [[nodiscard]] bool is_leaf() const { return (word_ & kLeaf) != 0; }
  /// The number of a node.
  [[nodiscard]] std::uint32_t node() const { return word_ / kUnits; }
  [[nodiscard]] std::uint32_t unit() const { return word_ & (kMostUnits - 1); }

  static constexpr std::uint32_t kNodeUnits = kUnits;
  static constexpr std::uint32_t kMostUnits = std::uint32_t{1} << 30;
  static constexpr std::uint32_t kLeaf = 0x80000000U;

 private:
  explicit BasicFastChild(std::uint32_t word) : word_(word) {}

  std::uint32_t word_;
};

}  // namespace grove
