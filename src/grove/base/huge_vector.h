#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace grove {

/// Memory for large arrays: aligned to 64 bytes, and from 4 MiB on to 2 MiB with the system asked to back it by huge pages, so that random
/// access misses the TLB less and first use faults less. Throws std::bad_alloc.
[[nodiscard]] void* allocate_huge(std::size_t bytes);
void free_huge(void* memory, std::size_t bytes) noexcept;

/// The allocator of HugeVector. Elements made by resize are left uninitialised when their type allows it.
template <typename T>
struct HugePageAllocator {
  using value_type = T;

  HugePageAllocator() = default;
  template <typename U>
  HugePageAllocator(const HugePageAllocator<U>& /*other*/) {}  // NOLINT(google-explicit-constructor): containers rebind it

  [[nodiscard]] T* allocate(std::size_t count) { return static_cast<T*>(allocate_huge(count * sizeof(T))); }
  void deallocate(T* memory, std::size_t count) noexcept { free_huge(memory, count * sizeof(T)); }

  template <typename U>
  void construct(U* place) {
    ::new (static_cast<void*>(place)) U;
  }
  template <typename U, typename... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
  }

  friend bool operator==(const HugePageAllocator& /*a*/, const HugePageAllocator& /*b*/) { return true; }
};

/// A std::vector on huge pages. Mind: resize does not zero plain data.
template <typename T>
using HugeVector = std::vector<T, HugePageAllocator<T>>;

}  // namespace grove
