// Tension of the interface between two fluids as a stress in a layer as thick as the kernel (Lafaurie et al.
// 1994; Hu & Adams 2006, eqs. 17-19): Pi = sigma (I - n n) |grad C|, where grad C = sum_j V_j grad_i W over
// the particles j of the other fluid, n = grad C / |grad C|, and F_ij = V_i V_j (Pi_i + Pi_j) grad_i W. No
// curvature, and momentum is conserved pair by pair. |grad C| is the kernel's profile across the layer: its
// integral is 1.
#pragma once

#include "sph/pairs/pair_values.hpp"
#include "sph/terms/stress.hpp"

namespace sph {

struct ColourGradient {
  static constexpr std::string_view name = "ColourGradient";
  static constexpr ValueSet reads{Value::volume, Value::side};
  static constexpr Field writes = Field::colour_gradient;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    using V = typename P::V;
    const V s = where_equal(p.template i<Value::side>() * p.template j<Value::side>(), V(-1),
                            p.template j<Value::volume>() * p.f);
    for (int a = 0; a < P::dim; ++a) sums.template add<Field::colour_gradient>(a, -(s * p.e[a]));
  }
};

struct SurfaceTension : TensorDivergence<Value::capillary> {
  static constexpr std::string_view name = "SurfaceTension";
};

}  // namespace sph
