// The pressures of bubbly magma, eight particles at a time: a division and a root of one wait for those before them, those
// of eight particles do not wait for each other. What is not usual, such as a particle without gas, and powers other than 1
// and 1/2 take the way of a single particle.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "laws/bubbly_formulas.hpp"
#include "sph/laws/eos/bubbly.hpp"

namespace sph {
namespace {

using V = Simd<double>;

struct Lanes {
  BubblyFormulas<V> law;
  V rho, p_sat;
  Int64x8 usual;  ///< -1 where there is gas, and the root lies where it should
};

Lanes load(const Group& g, const EosRows& rows, std::size_t first, std::size_t last) {
  V m, rho;
  for (int l = 0; l < V::lanes; ++l) {
    const std::size_t i = std::min(first + static_cast<std::size_t>(l), last - 1);
    m.set(l, rows.gas_content[i]);
    rho.set(l, rows.density[i]);
  }
  const BubblyFormulas<V> law{g.density,
                              g.eos.bulk_modulus,
                              g.bubbly.gas_rt,
                              g.bubbly.solubility_pressure,
                              g.bubbly.solubility_exponent,
                              m};
  const auto [pressure, density] = law.saturation();
  const Int64x8 usual =
      (m > 0) & (rho > 0) & (rho < density) & (pressure > 0) & (pressure < g.bubbly.gas_rt * density);
  return {law, rho, pressure, usual};
}

bool any(const Int64x8& mask) {
  std::int64_t bits = 0;
  for (int l = 0; l < V::lanes; ++l) bits |= mask[l];
  return bits != 0;
}

/// BubblyEos::invert() of the usual lanes; those that it does not come to an end with are usual no more.
V invert(Lanes& of) {
  V p = min(of.law.first_guess(of.rho, of.p_sat), of.p_sat), low = V::zero(), high = of.p_sat;
  Int64x8 open = of.usual & (p > 0);
  of.usual = open;
  for (int step = 0; step < most_bubbly_steps && any(open); ++step) {
    const auto [h, slope] = of.law.balance(of.rho, p);
    low = choose(open & (h > 0), p, low);
    high = choose(open & ~(h > 0), p, high);
    const V next = p - p * (h / slope), change = next - p;
    const Int64x8 near = open & (choose(change < 0, -change, change) <= bubbly_tolerance * p);
    const V inside = choose(next < low, low, choose(high < next, high, next));
    const V trial = choose((next > low) & (next < high), next, 0.5 * (low + high));
    p = choose(near, inside, choose(open, trial, p));
    open = open & ~near & (p > 0);
  }
  of.usual = of.usual & ~open & (p > 0) & (p < of.p_sat);
  return p;
}

void derive_rows(const Group& g, const EosRows& rows, std::size_t first, std::size_t last) {
  Lanes lanes = load(g, rows, first, last);
  const V p = invert(lanes), sound = lanes.law.sound_speed(p), psi = lanes.law.void_fraction(p);
  for (std::size_t i = first; i < last; ++i) {
    const int l = static_cast<int>(i - first);
    if (lanes.usual[l] == 0) {
      BubblyMagma::derive_row(bubbly_eos(g, rows.gas_content[i]), rows, i);
      continue;
    }
    rows.pressure[i] = p[l] - rows.surface_pressure;
    if (rows.sound_speed != nullptr) rows.sound_speed[i] = sound[l];
    if (rows.void_fraction != nullptr) rows.void_fraction[i] = psi[l];
  }
}

}  // namespace

void derive_in_equilibrium(const Group& g, const EosRows& rows, std::size_t first, std::size_t last) {
  const double gamma = g.bubbly.solubility_exponent;
  if ((gamma == 1 || gamma == 0.5) && last > first + 1) {
    for (std::size_t i = first; i < last; i += V::lanes)
      derive_rows(g, rows, i, std::min(last, i + V::lanes));
    return;
  }
  const BubblyEos usual = bubbly_eos(g, g.bubbly.gas_content);
  for (std::size_t i = first; i < last; ++i) {
    const double gas = rows.gas_content[i];
    BubblyMagma::derive_row(gas == g.bubbly.gas_content ? usual : bubbly_eos(g, gas), rows, i);
  }
}

}  // namespace sph
