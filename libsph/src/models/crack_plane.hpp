// The plane along which a crack grows. A lattice offers few directions, and cracks that take whatever particle is the
// furthest beyond its strength follow its rows and diagonals. So what fails keeps a plane that need not pass through it, its
// normal m and the particle's distance d from it; beside it a crack goes on along the mean of the failed neighbours' planes,
//   A_i = sum w m m,   b_i = sum w m (d_k + m.(x_i - x_k)),   m_i: principal axis of A_i,   d_i = m_i.b_i / m_i.A_i m_i
// and what is off its plane is the stronger there: of a turned lattice a crack takes the particles that are nearest to its
// plane, row by row. Where the plane is sheared it turns as it goes on, until it is not (local symmetry, K_II = 0:
// Gol'dstein & Salganik 1974), by a part of the angle -2 K_II / K_I of Erdogan & Sih (1963), the stress s being K's measure:
//   m <- m + 2 (s m - (m.s m) m) / (m.s m + p) / memory
#pragma once

#include <array>
#include <span>

#include "sph/laws/principal_stress.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

struct CrackPlane {
  std::array<double, 3> normal{};  ///< of length 1
  double distance = 0;  ///< of the particle from it, positive on the normal's side, over the width of bonds
};

/// As principal_axes has it, of `d(d+1)/2` components; in a plane the third direction comes last.
[[nodiscard]] SymmetricTensor in_space(const double* components, int dim);
/// Of the sums b, then A, of a particle; A must not be 0.
[[nodiscard]] CrackPlane plane_of(const double* sums, int dim);
/// That across which tension is the largest, through the particle, and along `along` where there is any.
[[nodiscard]] CrackPlane plane_of_tension(const SymmetricTensor& stress, std::span<const double> along);
/// m.s m
[[nodiscard]] double tension_across(const CrackPlane& plane, const SymmetricTensor& stress);
/// By Hooke's law, of the deviator and what the pressure is more than at the start.
[[nodiscard]] double strain_across(const CrackPlane& plane, const SymmetricTensor& deviator, double pressure,
                                   const Group& rock);
/// So that it is not sheared; `inside`: pressure of what is in the crack.
[[nodiscard]] CrackPlane turned(const CrackPlane& plane, const SymmetricTensor& stress, double inside);
/// As a crack that came along `plane` goes on where it would follow `here`.
[[nodiscard]] CrackPlane gone_on(const CrackPlane& plane, const CrackPlane& here);

}  // namespace sph
