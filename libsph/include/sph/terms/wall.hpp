// Fixed walls as dummy particles (Adami et al. 2012, eqs. 23, 27): kernel sums over the moving neighbours of
// a wall particle, from which the update takes p_w = (sum p W + g.sum rho (x_w - x_f) W) / sum W and the
// velocity that makes the wall no-slip (wall_mirror.hpp), or the mean sum v W / sum W itself where it slips.
#pragma once

#include "sph/pairs/pair_values.hpp"
#include "sph/terms/head.hpp"

namespace sph {

/// `counts`: 1 of the fluid, else 0. `rise`: p_f - p_w at rest.
template <class Kernel, class P, class S>
void extrapolate(const P& p, typename P::V counts, typename P::V rise, S& sums) {
  using V = typename P::V;
  const V w = Kernel::template value<P::dim>(p.r) * counts;
  sums.template add<Field::wall_sums>(0, w);
  sums.template add<Field::wall_sums>(1, w * (p.template j<Value::pressure>() - rise));
  for (int k = 0; k < P::dim; ++k)
    sums.template add<Field::wall_sums>(2 + k, w * p.template j<Value::velocity>(k));
  for (int k = 0; k < P::dim; ++k) sums.template add<Field::wall_sums>(2 + P::dim + k, w * p.e[k]);
}

template <class Kernel, class P, class S>
void extrapolate_by_density(const P& p, typename P::V rise, S& sums) {
  using V = typename P::V;
  const V w = Kernel::template value<P::dim>(p.r) * p.template j<Value::mover>();
  const V wp = w * (p.template j<Value::pressure>() - rise);
  for (int k = 0; k < 2; ++k) {
    const V wanted(static_cast<typename P::Scalar>(k));
    sums.template add<Field::wall_sums_by_density>(2 * k,
                                                   where_equal(p.template j<Value::heavy>(), wanted, w));
    sums.template add<Field::wall_sums_by_density>(2 * k + 1,
                                                   where_equal(p.template j<Value::heavy>(), wanted, wp));
  }
}

struct WallExtrapolation {
  static constexpr std::string_view name = "WallExtrapolation";
  static constexpr bool over_movers = true;
  static constexpr ValueSet reads{Value::velocity, Value::pressure, Value::weight, Value::mover};
  static constexpr Field writes = Field::wall_sums;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    extrapolate<Kernel>(p, p.template j<Value::mover>(), p.template j<Value::weight>() * head(p, c), sums);
  }
};

/// Where fluids of two densities meet at a wall there is no one pressure to extrapolate: a head of the
/// heavier fluid would throw the lighter away. Lighter and heavier ones each have their own.
struct WallExtrapolationByDensity {
  static constexpr std::string_view name = "WallExtrapolationByDensity";
  static constexpr bool over_movers = true;
  static constexpr ValueSet reads{Value::pressure, Value::weight, Value::mover, Value::heavy};
  static constexpr Field writes = Field::wall_sums_by_density;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    extrapolate_by_density<Kernel>(p, p.template j<Value::weight>() * head(p, c), sums);
  }
};

/// The same of a fluid with grains in it, whose pressure carries their weight and drag.
struct MixtureWallExtrapolation {
  static constexpr std::string_view name = "MixtureWallExtrapolation";
  static constexpr bool over_movers = true;
  static constexpr ValueSet reads{Value::velocity, Value::pressure, Value::mover, Value::rest_gradient};
  static constexpr Field writes = Field::wall_sums;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    extrapolate<Kernel>(p, p.template j<Value::mover>(), rise_from_wall(p), sums);
  }
};
struct MixtureWallExtrapolationByDensity {
  static constexpr std::string_view name = "MixtureWallExtrapolationByDensity";
  static constexpr bool over_movers = true;
  static constexpr ValueSet reads{Value::pressure, Value::mover, Value::heavy, Value::rest_gradient};
  static constexpr Field writes = Field::wall_sums_by_density;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    extrapolate_by_density<Kernel>(p, rise_from_wall(p), sums);
  }
};

/// How viscous the fluid beside a wall is, where that differs from particle to particle.
struct WallViscosity {
  static constexpr std::string_view name = "WallViscosity";
  static constexpr bool over_movers = true;
  static constexpr ValueSet reads{Value::volume, Value::viscosity, Value::mover};
  static constexpr Field writes = Field::wall_viscosity;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    using V = typename P::V;
    const V w =
        Kernel::template value<P::dim>(p.r) * p.template j<Value::mover>() * p.template j<Value::volume>();
    sums.template add<Field::wall_viscosity>(0, w);
    sums.template add<Field::wall_viscosity>(1, w * p.template j<Value::viscosity>());
  }
};

/// How much of a moving particle's kernel the walls fill, and the gradient of that: distance and
/// direction of a flat wall follow (sph/models/wall_distance.hpp).
struct WallShare {
  static constexpr std::string_view name = "WallShare";
  static constexpr bool over_walls = true;
  static constexpr ValueSet reads{Value::volume, Value::mover};
  static constexpr Field writes = Field::wall_share;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    using V = typename P::V;
    const V volume = where_equal(p.template j<Value::mover>(), V::zero(), p.template j<Value::volume>());
    for (int k = 0; k < P::dim; ++k) sums.template add<Field::wall_share>(k, -(volume * p.f * p.e[k]));
    sums.template add<Field::wall_share>(P::dim, volume * Kernel::template value<P::dim>(p.r));
  }
};

}  // namespace sph
