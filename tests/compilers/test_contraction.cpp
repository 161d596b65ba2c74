// Linked with a self_check.cpp that was compiled with -ffp-contract=fast for a CPU with FMA: must be refused.
#include <cstdio>
#include <cstring>
#include <exception>

#include "sph/self_check.hpp"

int main() {
  if (!__builtin_cpu_supports("fma")) {
    std::puts("skipped: this CPU has no FMA");
    return 0;
  }
  try {
    sph::self_check();
  } catch (const std::exception& e) {
    std::puts(e.what());
    return std::strstr(e.what(), "rules of the numbers") != nullptr ? 0 : 1;
  }
  std::puts("a contracted build passed the self-check");
  return 1;
}
