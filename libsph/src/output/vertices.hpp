// The data set /vertex of a snapshot: 0, 1, 2, ... for its rows, four bytes each. In XDMF points are cells
// that list their vertices. "XDMF Reader" takes missing lists for these, "Xdmf3 Reader" for none at all and
// draws nothing.
#pragma once

#include <cstdint>
#include <limits>

#include "sph/core/fields.hpp"

namespace sph {

/// XDMF knows no unsigned numbers of eight bytes.
[[nodiscard]] constexpr Type vertex_type(std::uint64_t rows) {
  return rows <= std::numeric_limits<std::uint32_t>::max() ? Type::u32 : Type::i64;
}

}  // namespace sph
