// Pair rows that are not packed yet, made loud (decomp/poison.hpp).
#pragma once

#include "decomp/poison.hpp"
#include "sph/pairs/pass_context.hpp"

namespace sph {

/// Rows [first, last) of `row_bytes` each; nothing in builds that do not poison.
inline void poison_rows(const PassContext& context, int row_bytes, std::size_t first, std::size_t last) {
  if (!decomp::poisons()) return;
  const auto bytes = static_cast<std::size_t>(row_bytes);
  decomp::poison(aligned_scratch(*context.rows, last * bytes) + first * bytes, (last - first) * bytes);
}

}  // namespace sph
