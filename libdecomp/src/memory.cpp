#include "decomp/memory.hpp"

#include <malloc.h>
#include <sys/mman.h>

#include <cstdlib>

namespace decomp {

void return_freed_memory() {
#if defined(M_MMAP_THRESHOLD)
  mallopt(M_MMAP_THRESHOLD, 16 << 20);  // setting it stops it from growing
#endif
#if defined(M_TRIM_THRESHOLD)
  mallopt(M_TRIM_THRESHOLD, 64 << 20);  // what is taken again and again would fault its pages in each time
#endif
}

void* allocate_large(std::size_t bytes) {
  constexpr std::size_t huge_page = std::size_t{1} << 21;
  const bool huge = bytes >= 2 * huge_page;
  const std::size_t unit = huge ? huge_page : cache_line;
  const std::size_t size = (bytes + unit - 1) / unit * unit;
  void* memory = std::aligned_alloc(unit, size == 0 ? unit : size);
  if (memory == nullptr) throw std::bad_alloc();
#if defined(MADV_HUGEPAGE)
  if (huge) (void)::madvise(memory, size, MADV_HUGEPAGE);  // a wish: without it everything still works
#endif
  return memory;
}

void release_large(void* memory) noexcept { std::free(memory); }

}  // namespace decomp
