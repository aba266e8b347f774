#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace grove {

/// The keys of a request such as "mount?size=512&seed=3". Every wrong key or value is a UsageError that lists what is allowed.
class BuiltinOptions {
 public:
  /// Splits "NAME?key=value&key=value".
  explicit BuiltinOptions(std::string_view request);

  [[nodiscard]] const std::string& name() const { return name_; }

  /// To be called first: throws unless every key given is one of these, and given once.
  void allow_only(std::initializer_list<std::string_view> keys) const;

  [[nodiscard]] bool has(std::string_view key) const { return find(key) != nullptr; }
  /// An integer from `least` to `most`, or `fallback` where the key is not given.
  [[nodiscard]] std::uint64_t integer(std::string_view key, std::uint64_t fallback, std::uint64_t least, std::uint64_t most) const;
  /// The same for a number with a fraction.
  [[nodiscard]] double number(std::string_view key, double fallback, double least, double most) const;
  /// One of `allowed`, the first where the key is not given.
  [[nodiscard]] std::string_view choice(std::string_view key, std::initializer_list<std::string_view> allowed) const;
  [[nodiscard]] bool boolean(std::string_view key, std::string_view fallback) const;
  [[nodiscard]] std::uint64_t seed() const;

  /// The wanted number of primitives from `triangles` or `primitives`; 0 where neither is given. Throws when more than one of
  /// `size`, `triangles` and `primitives` is.
  [[nodiscard]] std::uint64_t target() const;

  [[noreturn]] void fail(std::string_view problem) const;

 private:
  struct Entry {
    std::string key;
    std::string value;
  };
  [[nodiscard]] const std::string* find(std::string_view key) const;

  std::string name_;
  std::vector<Entry> entries_;
};

/// No built-in scene has more primitives than this: beyond it memory, not the request, would be the limit.
inline constexpr std::uint64_t kMaxBuiltinPrimitives = 200'000'000;

/// The n in [least, most] for which `count(n)`, which grows with n, is nearest to `target`.
template <typename Count>
[[nodiscard]] std::uint64_t nearest_size(std::uint64_t target, std::uint64_t least, std::uint64_t most, const Count& count) {
  std::uint64_t low = least;
  std::uint64_t high = most;
  while (low < high) {
    const std::uint64_t middle = low + (high - low) / 2;
    if (count(middle) < target) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  // low is the first that reaches the target, or the last of all; the one before may be nearer.
  if (low > least && count(low) >= target && target - count(low - 1) < count(low) - target) --low;
  return low;
}

}  // namespace grove
