// Twice the harmonic mean, 4 a b / (a + b), 0 of two that are 0: what pairs weigh fluxes by where a coefficient jumps.
#pragma once

#include "sph/pairs/pair_values.hpp"

namespace sph {

/// `tiny` is less than any sum of the two but 0.
template <class V>
[[nodiscard, gnu::always_inline]] inline V twice_harmonic_mean(V a, V b, V tiny) {
  return V(4) * (a * b) / max(a + b, tiny);
}

}  // namespace sph
