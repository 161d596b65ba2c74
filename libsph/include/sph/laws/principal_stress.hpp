// Principal values and axes of a symmetric tensor by cyclic Jacobi rotations (Jacobi 1846; Golub & Van Loan, Matrix
// Computations, section 8.5): sqrt and division alone, so the bits are the same on every machine. Values come sorted,
// the largest first; values and tensor_of() are good to rounding of the largest.
#pragma once

#include <array>

namespace sph {

/// xx yy zz xy xz yz
using SymmetricTensor = std::array<double, 6>;

struct PrincipalAxes {
  std::array<double, 3> values{};
  std::array<std::array<double, 3>, 3> axes{};  ///< axes[k]: unit vector that belongs to values[k]
};

/// What is not finite stays so.
[[nodiscard]] PrincipalAxes principal_axes(const SymmetricTensor& tensor);
/// sum over k of values[k] axes[k] axes[k]^T
[[nodiscard]] SymmetricTensor tensor_of(const PrincipalAxes& principal);

}  // namespace sph
