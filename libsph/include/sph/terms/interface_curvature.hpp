// Curvature of the interface between two fluids, from the normals n of the colour gradients near it (they
// point from the first fluid to the second on both sides). A least-squares fit of n along the interface, each
// partner weighted with the kernel and with its part of the layer, a_j = V_j |grad C|_j:
//   kappa_i = (D - 1) sum_j a_j W (n_j - n_i).t_ij / sum_j a_j W |t_ij|^2,   t = (I - n_i n_i) (x_j - x_i).
// All weights are positive and all divisions are by sums of squares: no correction matrix that particles in
// disorder could make singular. CurvatureMean is the mean of kappa over the layer, with the weights a_j W:
// what particles do that are a spacing apart is no curvature that a fluid could resist.
#pragma once

#include "sph/pairs/pair_values.hpp"

namespace sph {

struct Curvature {
  static constexpr std::string_view name = "Curvature";
  static constexpr ValueSet reads{Value::interface_normal, Value::interface_weight};
  static constexpr Field writes = Field::curvature_sums;
  static constexpr Value nothing_without = Value::interface_weight;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    using V = typename P::V;
    V along = V::zero();
    for (int a = 0; a < P::dim; ++a) along += p.template i<Value::interface_normal>(a) * p.e[a];
    V turn = V::zero(), square = V::zero();
    for (int a = 0; a < P::dim; ++a) {
      const V t = p.e[a] - along * p.template i<Value::interface_normal>(a);
      turn += (p.template j<Value::interface_normal>(a) - p.template i<Value::interface_normal>(a)) * t;
      square += t * t;
    }
    const V weight = p.template j<Value::interface_weight>() * Kernel::template value<P::dim>(p.r);
    sums.template add<Field::curvature_sums>(0, weight * turn);
    sums.template add<Field::curvature_sums>(1, weight * square);
  }
};

struct CurvatureMean {
  static constexpr std::string_view name = "CurvatureMean";
  static constexpr ValueSet reads{Value::interface_weight, Value::curvature};
  static constexpr Field writes = Field::curvature_sums;
  static constexpr Value nothing_without = Value::interface_weight;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    using V = typename P::V;
    // Lists are padded with the particle itself.
    const V all = p.template j<Value::interface_weight>() * Kernel::template value<P::dim>(p.r);
    const V weight = all - where_equal(p.r2, V::zero(), all);
    sums.template add<Field::curvature_sums>(0, weight * p.template j<Value::curvature>());
    sums.template add<Field::curvature_sums>(1, weight);
  }
};

}  // namespace sph
