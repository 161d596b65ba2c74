// Memory of large arrays. It begins on a cache line; from 4 MB on it begins on a huge page and the system is
// asked to back it with such: neighbours in space are not neighbours in memory, and with small pages a step
// spends much of its time walking page tables (twice over on a virtual machine).
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace decomp {

/// Lets large blocks go back to the system when they are freed, whatever their use before: what a rebuild
/// takes for a moment must not stay beside what an output takes. Once, at the start of a program.
void return_freed_memory();

inline constexpr std::size_t cache_line = 64;

/// Throws std::bad_alloc.
[[nodiscard]] void* allocate_large(std::size_t bytes);
void release_large(void* memory) noexcept;

template <class T>
struct LargeAllocator {
  using value_type = T;
  LargeAllocator() = default;
  template <class U>
  LargeAllocator(const LargeAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(allocate_large(n * sizeof(T))); }
  void deallocate(T* p, std::size_t) { release_large(p); }
  friend bool operator==(LargeAllocator, LargeAllocator) { return true; }
};

/// As std::vector, but its elements begin on a cache line.
template <class T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

/// Empties a vector and gives its memory back, which `v = {}` keeps.
template <class Vector>
void release(Vector& v) {
  Vector().swap(v);
}

}  // namespace decomp
