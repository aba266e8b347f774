#include "grove/base/huge_vector.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace grove {
namespace {

constexpr std::size_t kCacheLine = 64;
constexpr std::size_t kHugePage = std::size_t{2} << 20;

std::size_t round_up(std::size_t bytes, std::size_t unit) {
  const std::size_t rounded = (bytes + unit - 1) / unit * unit;
  if (rounded < bytes) throw std::bad_alloc();
  return rounded;
}

// The address sanitizer watches over the heap alone.
#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__)

bool is_mapped(std::size_t bytes) {
  return bytes >= 2 * kHugePage;
}

// Straight from the system, and back to it when freed: in the heap, blocks aligned to huge pages leave holes between them that add up
// to more than the blocks.
void* map(std::size_t bytes) {
  const std::size_t size = round_up(bytes, kHugePage);
  const std::size_t mapped = size + kHugePage;
  if (mapped < size) throw std::bad_alloc();
  void* const memory = mmap(nullptr, mapped, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  auto* const begin = static_cast<std::byte*>(memory);
  const std::size_t before = (kHugePage - reinterpret_cast<std::uintptr_t>(memory) % kHugePage) % kHugePage;
  if (before > 0) munmap(begin, before);
  munmap(begin + before + size, kHugePage - before);
  // Advice only: where the system has no huge pages, nothing changes.
  static_cast<void>(madvise(begin + before, size, MADV_HUGEPAGE));
  return begin + before;
}

void unmap(void* memory, std::size_t bytes) {
  munmap(memory, round_up(bytes, kHugePage));
}

#else

bool is_mapped(std::size_t /*bytes*/) {
  return false;
}
void* map(std::size_t /*bytes*/) {
  throw std::bad_alloc();
}
void unmap(void* /*memory*/, std::size_t /*bytes*/) {}

#endif

}  // namespace

void* allocate_huge(std::size_t bytes) {
  if (is_mapped(bytes)) return map(bytes);
  void* const memory = std::aligned_alloc(kCacheLine, round_up(std::max(bytes, kCacheLine), kCacheLine));
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void free_huge(void* memory, std::size_t bytes) noexcept {
  if (is_mapped(bytes)) {
    unmap(memory, bytes);
  } else {
    std::free(memory);
  }
}

}  // namespace grove
