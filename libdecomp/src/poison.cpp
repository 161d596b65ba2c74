#include "decomp/poison.hpp"

namespace decomp {

bool poisons() noexcept {
#if defined(PEPERITE_POISON) || !defined(NDEBUG)
  return true;
#else
  return false;
#endif
}

}  // namespace decomp
