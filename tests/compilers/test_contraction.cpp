// Linked with a self_check.cpp that was compiled with -ffp-contract=fast for a CPU with FMA: must be refused.
#include <cstdio>
#include <cstring>
#include <exception>

#include "sph/run/self_check.hpp"

int main(int argc, char** argv) {
  if (argc > 1) {
    const bool help = std::strcmp(argv[1], "--help") == 0 || std::strcmp(argv[1], "-h") == 0;
    std::fputs("contraction: no arguments; exits 0 if the self-check refuses a contracted build\n",
               help ? stdout : stderr);
    return help ? 0 : 2;
  }
#if defined(__x86_64__)  // others always have it
  if (!__builtin_cpu_supports("fma")) {
    std::puts("skipped: this CPU has no FMA");
    return 0;
  }
#endif
  try {
    sph::self_check();
  } catch (const std::exception& e) {
    std::puts(e.what());
    return std::strstr(e.what(), "rules of the numbers") != nullptr ? 0 : 1;
  }
  std::puts("a contracted build passed the self-check");
  return 1;
}
