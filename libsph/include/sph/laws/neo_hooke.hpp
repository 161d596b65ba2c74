// Hyperelastic stress of one particle from the displacement gradient H = F - 1: compressible neo-Hookean of
// Smith, de Goes & Kim (2018, eq. 13, without their origin barrier),
//   psi = mu/2 (tr F^T F - 3) - mu (J - 1) + lambda'/2 (J - 1)^2,   lambda' = K + mu/3,
// so that small strains have the moduli K and mu. Rational, finite for every F, and does not soften under
// compression, where St. Venant-Kirchhoff collapses at 0.58 of the length. In 2D plane strain, F_zz = 1.
// A pressure p_0 in the reference state adds -p_0 (J - 1) to psi.
// Written in H, so that small strains lose no digits; a rigid rotation gives no stress but rounding.
#pragma once

#include <Eigen/Core>

namespace sph {

template <int D>
using Tensor = Eigen::Matrix<double, D, D, Eigen::RowMajor>;

template <int D>
struct ElasticState {
  Tensor<D> first_piola;  ///< P = d psi/d F [Pa]
  double volume_change;   ///< J - 1
  double energy;          ///< psi, per reference volume [J/m^3]
};

template <int D>
[[nodiscard]] ElasticState<D> neo_hooke(const Tensor<D>& h, double bulk_modulus, double shear_modulus,
                                        double pressure = 0);

extern template ElasticState<2> neo_hooke<2>(const Tensor<2>&, double, double, double);
extern template ElasticState<3> neo_hooke<3>(const Tensor<3>&, double, double, double);

}  // namespace sph
