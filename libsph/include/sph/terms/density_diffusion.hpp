// Density diffusion (Molteni & Colagrossi 2009) on the pressure difference less its hydrostatic part
// (Fourtakas et al. 2019): d rho_i/dt += 2 delta h sum_j V_j (p_i - p_j + rho_ij g.(x_j - x_i)) / c_ij  W'/r,
// only between particles of one group. c_ij is the larger of the two: the stiffer particle's pressure then
// relaxes at the rate delta c / h, bounded by its own acoustic rate. With the smaller c a liquid particle
// (c = 2800 m/s) beside a foamed one (36 m/s) would relax at delta c_l^2 / (c_f h): unstable at any useful
// dt. V_i d rho_i is antisymmetric: the pairs exchange density, none is made.
#pragma once

#include "sph/pairs/pair_values.hpp"
#include "sph/terms/head.hpp"

namespace sph {

/// rise: p_j - p_i where nothing flows.
template <class P, class S>
void exchange_density(const P& p, typename P::V rise, S& sums) {
  using V = typename P::V;
  const V excess = p.template i<Value::pressure>() - p.template j<Value::pressure>() + rise;
  const V sound = max(p.template i<Value::sound_speed>(), p.template j<Value::sound_speed>());
  const V rate = p.template j<Value::volume>() * p.f * (excess / sound);
  sums.template add<Field::diffusion>(
      0, where_equal(p.template i<Value::phase>(), p.template j<Value::phase>(), rate));
}

template <class P>
[[nodiscard]] typename P::V weight_between(const P& p) {
  return typename P::V(typename P::Scalar(0.5)) *
         (p.template i<Value::weight>() + p.template j<Value::weight>());
}

struct DensityDiffusion {
  static constexpr std::string_view name = "DensityDiffusion";
  static constexpr ValueSet reads{Value::volume, Value::pressure, Value::weight, Value::sound_speed,
                                  Value::phase};
  static constexpr Field writes = Field::diffusion;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    exchange_density(p, weight_between(p) * head(p, c), sums);
  }
};

/// The same under a central pull, whose potential phi takes the part of -g.x: without it the rim of a drop at
/// rest would gain density at the rate delta B^2 R / c, as the surface of a tank would without its g.x.
struct PulledDensityDiffusion {
  static constexpr std::string_view name = "PulledDensityDiffusion";
  static constexpr ValueSet reads = DensityDiffusion::reads | ValueSet{Value::potential};
  static constexpr Field writes = Field::diffusion;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    const auto rest = p.template i<Value::potential>() - p.template j<Value::potential>() + head(p, c);
    exchange_density(p, weight_between(p) * rest, sums);
  }
};

/// The same of a fluid with grains in it. With the weight of the fluid alone all of a bed would sink, at the rate
/// 2 delta h g phi / c.
struct MixtureDensityDiffusion {
  static constexpr std::string_view name = "MixtureDensityDiffusion";
  static constexpr ValueSet reads{Value::volume, Value::pressure, Value::sound_speed, Value::phase,
                                  Value::rest_gradient};
  static constexpr Field writes = Field::diffusion;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    exchange_density(p, rise_between_grains(p), sums);
  }
};

/// The same in a scene of one linear fluid: c and, as in Fourtakas et al., the density of the hydrostatic part are
/// constants, and what is no wall is of one group.
struct UniformDensityDiffusion {
  static constexpr std::string_view name = "UniformDensityDiffusion";
  static constexpr ValueSet reads{Value::volume, Value::pressure, Value::mover};
  static constexpr Field writes = Field::diffusion;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C& c, S& sums) {
    using V = typename P::V;
    V head = V::zero();
    for (int k = 0; k < P::dim; ++k) head += V(c.gravity[k] * c.density) * p.e[k];
    const V excess = p.template i<Value::pressure>() - p.template j<Value::pressure>() + head;
    const V rate = p.template j<Value::volume>() * p.f * (excess * V(c.inverse_sound_speed));
    sums.template add<Field::diffusion>(0, where_equal(p.template j<Value::mover>(), V(1), rate));
  }
};

}  // namespace sph
