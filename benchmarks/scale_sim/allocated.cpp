#include "allocated.hpp"

#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <new>

namespace scale_sim::allocated {
namespace {

std::size_t in_use = 0, most = 0;

}  // namespace

std::size_t now() { return in_use; }
std::size_t peak() { return most; }
void restart_peak() { most = in_use; }

}  // namespace scale_sim::allocated

void* operator new(std::size_t bytes) {
  using namespace scale_sim::allocated;
  void* const memory = std::malloc(bytes);
  if (memory == nullptr) throw std::bad_alloc();
  in_use += malloc_usable_size(memory);
  most = std::max(most, in_use);
  return memory;
}

void operator delete(void* memory) noexcept {
  scale_sim::allocated::in_use -= malloc_usable_size(memory);
  std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept { operator delete(memory); }
