// A function tabulated at 0, 1, 2, ..., by straight lines between.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sph {

/// `place` at least 0; beyond the table the last line goes on.
[[nodiscard]] inline double between(const std::vector<double>& table, double place) {
  const auto k = std::min(static_cast<std::size_t>(place), table.size() - 2);
  const double part = place - static_cast<double>(k);
  return table[k] + part * (table[k + 1] - table[k]);
}

}  // namespace sph
