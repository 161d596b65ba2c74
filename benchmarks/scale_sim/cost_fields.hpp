// Synthetic costs of columns of cells, as the scenes have them: what the balancers are judged on.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace fields {

/// cost(x, y) of a cell at x, y in (0, 1), columns along x; a ripple stands for grains not being a continuum.
template <class Cost>
std::vector<double> sampled(std::int64_t rows, std::int64_t columns, Cost cost) {
  std::vector<double> field;
  field.reserve(static_cast<std::size_t>(rows * columns));
  for (std::int64_t r = 0; r < rows; ++r)
    for (std::int64_t c = 0; c < columns; ++c) {
      const double x = (static_cast<double>(c) + 0.5) / static_cast<double>(columns),
                   y = (static_cast<double>(r) + 0.5) / static_cast<double>(rows);
      const double ripple =
          1 + 0.05 * std::sin(12.9898 * static_cast<double>(c) + 78.233 * static_cast<double>(r));
      field.push_back(cost(x, y) * ripple);
    }
  return field;
}

/// A layer of sand with a wedge in front of the wall at x = 0.
inline std::vector<double> wedge(std::int64_t rows, std::int64_t columns) {
  return sampled(rows, columns, [](double x, double y) {
    return 1 + std::max(0.0, 1.6 * (1 - x / 0.5)) * (1 + 0.1 * std::sin(6 * std::numbers::pi * y));
  });
}

/// Water behind a dam, a thin film (or walls) in front of it; `front` in (0, 1).
inline std::vector<double> dam(std::int64_t rows, std::int64_t columns, double front = 0.25) {
  return sampled(rows, columns, [&](double x, double) { return x < front ? 1.0 : 0.02; });
}

/// The same later: a slope that runs out.
inline std::vector<double> late_dam(std::int64_t rows, std::int64_t columns) {
  return sampled(rows, columns, [](double x, double y) {
    const double edge = 0.85 + 0.05 * std::sin(4 * std::numbers::pi * y);
    return 0.02 + 1.2 * std::sqrt(std::max(0.0, 1 - x / edge));
  });
}

/// A conical heap in a large empty tray.
inline std::vector<double> heap(std::int64_t rows, std::int64_t columns) {
  return sampled(rows, columns, [](double x, double y) {
    return 0.005 + std::max(0.0, 1 - std::hypot(x - 0.45, y - 0.55) / 0.3);
  });
}

}  // namespace fields
