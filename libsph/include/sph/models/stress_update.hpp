// Elastic stress of one particle over one step: Hooke's law in rate form, Ida (2009) eq. (11), and in the
// conservative formulation the rotation of the stress with the body (Jaumann), done as a finite rotation
// by the Cayley transform Q = (1 - W dt/2)^-1 (1 + W dt/2), which is orthogonal to round-off and rational.
#pragma once

namespace sph {

/// s' = Q s Q^T + 2 mu dt dev(D), D = sym(grad v), dev in three dimensions (plane strain in 2D, where
/// s_zz = -(s_xx + s_yy) is implied). `gradient` is row by row, d v_i/d x_j; `s` is xx yy xy or
/// xx yy zz xy xz yz, updated in place.
template <int D>
void update_deviator(double* s, const double* gradient, double shear_modulus, double dt);

/// Ida's literal (11), not objective: sigma' = sigma + dt (lambda delta div v + mu (grad v + grad v^T)).
template <int D>
void update_hooke_literal(double* sigma, const double* gradient, double lambda, double mu, double dt);

extern template void update_deviator<2>(double*, const double*, double, double);
extern template void update_deviator<3>(double*, const double*, double, double);
extern template void update_hooke_literal<2>(double*, const double*, double, double, double);
extern template void update_hooke_literal<3>(double*, const double*, double, double, double);

}  // namespace sph
