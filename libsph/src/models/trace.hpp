// A sum that several models take of the velocity gradient: its trace, div v.
#pragma once

#include <cstddef>

namespace sph {

/// Of a matrix of d x d, row by row.
[[nodiscard]] inline double trace_of(const double* matrix, std::size_t d) {
  double t = 0;
  for (std::size_t a = 0; a < d; ++a) t += matrix[a * (d + 1)];
  return t;
}

}  // namespace sph
