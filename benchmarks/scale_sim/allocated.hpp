// Bytes that operator new has given out: what a data structure takes, measured.
#pragma once

#include <cstddef>

namespace scale_sim::allocated {

[[nodiscard]] std::size_t now();
[[nodiscard]] std::size_t peak();  ///< since restart_peak()
void restart_peak();

}  // namespace scale_sim::allocated
