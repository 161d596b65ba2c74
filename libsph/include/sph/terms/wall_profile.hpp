// What is straight between a particle and a wall's face (Morris et al. 1997, eq. 24): a wall particle has
//   u_i - u_w = (u_i - u_wall) n_i.(x_i - x_w) / d_i,
// with distance d_i and normal n_i of the face, exact where u is linear beside one flat wall. Between walls so near that
// no normal is found, u_i - u_w = u_i - u_wall.
#pragma once

#include "sph/pairs/pair_values.hpp"

namespace sph {

template <class V>
struct WallProfile {
  V across;     ///< n_i.(x_i - x_w) / d_i, 0 without a normal
  V steepness;  ///< (h / d_i)^2, 0 without a normal
  /// (u_i - u_w) / (u_i - u_wall), not negative.
  [[nodiscard]] V share() const { return max(across, V::zero()) + where_equal(steepness, V::zero(), V(1)); }
};

template <class P>
[[nodiscard]] WallProfile<typename P::V> wall_profile(const P& p) {
  using V = typename P::V;
  WallProfile<V> out{V::zero(), V::zero()};
  for (int a = 0; a < P::dim; ++a) {
    const V slope = p.template i<Value::wall_slope>(a);
    out.across -= slope * p.e[a];
    out.steepness += slope * slope;
  }
  return out;
}

}  // namespace sph
