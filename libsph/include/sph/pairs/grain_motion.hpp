// How grains move once their contacts are summed: with inertia, or where a flow carries them without.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sph/core/fixed_point.hpp"
#include "sph/core/particles.hpp"
#include "sph/core/simd_rows.hpp"
#include "sph/pairs/contact_context.hpp"

namespace sph {

/// Sums in whole quanta, whose bits depend on no order. benchmarks/contacts.cpp has what they cost.
struct QuantumSums {
  using Sum = std::uint64_t;
  static Int64x8 lanes(Simd<double> quanta) { return to_integers(quanta); }
  static Sum scalar(double quanta) { return static_cast<Sum>(round_to_quanta(quanta)); }
  static double value(Sum sum) { return static_cast<double>(static_cast<std::int64_t>(sum)); }
};

/// Columns of grains that a sweep reads and writes.
template <class Sum>
struct ContactRows {
  std::int64_t* x;
  double *v, *w;
  const double *radius, *mass;
  const std::uint32_t* group;
  Sum* sums;
  explicit ContactRows(const ContactContext& c)
      : x(c.particles->data<Field::position>()),
        v(c.particles->data<Field::velocity>()),
        w(c.particles->data<Field::spin>()),
        radius(c.particles->data<Field::radius>()),
        mass(c.particles->data<Field::mass>()),
        group(c.particles->data<Field::group>()),
        sums(reinterpret_cast<Sum*>(c.sums)) {}
};

/// `stride`: sums of a row.
template <bool spins, int stride, class Sums>
struct GrainMotion {
  using Rows = ContactRows<typename Sums::Sum>;
  using Sum = typename Sums::Sum;

  // v += (F/m + g) dt, g with what a caller gives, omega += T/I dt with I = 2/5 m r^2, then x += v dt in whole quanta.
  template <bool drifts>
  static void move(const ContactContext& c, const Rows& rows, std::size_t first, std::size_t last,
                   ContactSweep& sweep) {
    const double dt = c.dt;
    [[maybe_unused]] const double quanta = dt / c.quantum.length;
    double speed2 = sweep.speed2, acceleration2 = sweep.acceleration2;
    for (std::size_t r = first; r < last; ++r) {
      Sum* sums = rows.sums + r * stride;
      const double inverse_mass = 1 / rows.mass[r];
      double v2 = 0, a2 = 0;
      for (std::size_t a = 0; a < 3; ++a) {
        const double force = Sums::value(sums[a]) * c.quantum.force;
        double pull = c.gravity[a];
        if (c.given != nullptr) pull += c.given[r * 3 + a];
        const double acceleration = force * inverse_mass + pull;
        const double v = rows.v[r * 3 + a] + acceleration * dt;
        rows.v[r * 3 + a] = v;
        if constexpr (drifts) rows.x[r * 3 + a] = moved_by(rows.x[r * 3 + a], round_to_quanta(v * quanta));
        v2 += v * v;
        a2 += acceleration * acceleration;
      }
      if constexpr (spins) {
        const double turn = 2.5 * inverse_mass / (rows.radius[r] * rows.radius[r]) * c.quantum.torque * dt;
        for (std::size_t a = 0; a < 3; ++a) rows.w[r * 3 + a] += Sums::value(sums[4 + a]) * turn;
      }
      for (int k = 0; k < stride; ++k) sums[k] = 0;
      speed2 = v2 <= speed2 ? speed2 : v2;
      acceleration2 = a2 <= acceleration2 ? acceleration2 : a2;
    }
    sweep.speed2 = speed2;
    sweep.acceleration2 = acceleration2;
  }

  // v = free + mobility F and the same of the spin, then x += v dt in whole quanta.
  static void glide(const ContactContext& c, const Rows& rows, std::size_t first, std::size_t last,
                    ContactSweep& sweep) {
    const Gliding& with = c.gliding;
    const double quanta = c.dt / c.quantum.length;
    double speed2 = sweep.speed2;
    for (std::size_t r = first; r < last; ++r) {
      Sum* sums = rows.sums + r * stride;
      double v2 = 0;
      for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t k = r * 3 + a;
        const double force = Sums::value(sums[a]) * c.quantum.force;
        const double v = with.free_velocity[k] + force * with.mobility[r * 2];
        const std::int64_t way = round_to_quanta(v * quanta);
        rows.v[k] = v;
        rows.x[k] = moved_by(rows.x[k], way);
        with.way[k] = moved_by(with.way[k], way);
        with.force[k] = force;
        v2 += v * v;
        if constexpr (spins)
          rows.w[k] =
              with.free_spin[k] + Sums::value(sums[4 + a]) * c.quantum.torque * with.mobility[r * 2 + 1];
      }
      for (int k = 0; k < stride; ++k) sums[k] = 0;
      speed2 = v2 <= speed2 ? speed2 : v2;
    }
    sweep.speed2 = speed2;
  }
};

}  // namespace sph
