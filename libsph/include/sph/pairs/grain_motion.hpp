// How grains move once their contacts are summed: with inertia, or where a flow carries them without.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "sph/core/fixed_point.hpp"
#include "sph/core/particles.hpp"
#include "sph/core/simd_rows.hpp"
#include "sph/pairs/contact_context.hpp"

namespace sph {

typedef double FourDoubles __attribute__((vector_size(32)));
typedef std::int64_t FourIntegers __attribute__((vector_size(32)));

/// Sums in whole quanta, whose bits depend on no order. benchmarks/contacts.cpp has what they cost.
struct QuantumSums {
  using Sum = std::uint64_t;
  template <int bytes>
  static Simd<std::int64_t, bytes> lanes(Simd<double, bytes> quanta) {
    return to_integers(quanta);
  }
  static Sum scalar(double quanta) { return static_cast<Sum>(round_to_quanta(quanta)); }
  static FourDoubles values(const Sum* four) {
    FourIntegers sums;
    std::memcpy(&sums, four, sizeof sums);
    return __builtin_convertvector(sums, FourDoubles);
  }
};

/// Lines of grains that a sweep reads and writes.
template <class Sum>
struct ContactRows {
  static constexpr std::size_t motion_width = GrainLines::motion_width, spin_width = GrainLines::spin_width;
  double *motion, *spin;
  Sum* sums;
  explicit ContactRows(const ContactContext& c)
      : motion(c.particles->lines().motion.data()),
        spin(c.particles->lines().spin.data()),
        sums(reinterpret_cast<Sum*>(c.sums)) {}
  [[nodiscard]] double* x(std::size_t row) const { return motion + row * motion_width; }
  [[nodiscard]] double* v(std::size_t row) const { return motion + row * motion_width + 4; }
  [[nodiscard]] double* w(std::size_t row) const { return spin + row * spin_width; }
  [[nodiscard]] double radius(std::size_t row) const { return x(row)[3]; }
  [[nodiscard]] double mass(std::size_t row) const { return v(row)[3]; }
  [[nodiscard]] std::uint32_t group(std::size_t row) const { return static_cast<std::uint32_t>(w(row)[3]); }
};

/// Half a line at a time: what stands beside a vector in it (radius, mass, group) stays as it is.
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
    const FourDoubles gravity{c.pull.gravity[0], c.pull.gravity[1], c.pull.gravity[2], 0};
    const FourDoubles quanta = in_vector(dt / c.quantum.length);
    double speed2 = sweep.speed2, acceleration2 = sweep.acceleration2;
    for (std::size_t r = first; r < last; ++r) {
      Sum* sums = rows.sums + r * stride;
      const FourDoubles force = Sums::values(sums) * in_vector(c.quantum.force);
      FourDoubles pull = gravity;
      if (c.pull.given != nullptr)
        for (int a = 0; a < 3; ++a) pull[a] += c.pull.given[r * 3 + static_cast<std::size_t>(a)];
      const FourDoubles acceleration = force * std::bit_cast<double>(sums[3]) + pull;
      const FourDoubles v = load(rows.v(r)) + acceleration * dt;
      store(v, rows.v(r));
      if constexpr (drifts) drift(rows.x(r), v * quanta);
      if constexpr (spins) {
        const double turn = std::bit_cast<double>(sums[7]) * c.quantum.torque * dt;
        store(load(rows.w(r)) + Sums::values(sums + 4) * in_vector(turn), rows.w(r));
      }
      for (int k = 0; k < stride; k += 4) clear(sums + k);
      speed2 = larger_or_nan(square(v), speed2);
      acceleration2 = larger_or_nan(square(acceleration), acceleration2);
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
      const FourDoubles force = Sums::values(sums) * c.quantum.force;
      FourDoubles torque{};
      if constexpr (spins) torque = Sums::values(sums + 4) * c.quantum.torque;
      FourDoubles v = load(rows.v(r));
      for (int a = 0; a < 3; ++a) {
        const std::size_t k = r * 3 + static_cast<std::size_t>(a);
        v[a] = with.free_velocity[k] + force[a] * with.mobility[r * 2];
        with.way[k] = moved_by(with.way[k], round_to_quanta(v[a] * quanta));
        with.force[k] = force[a];
        if constexpr (spins) rows.w(r)[a] = with.free_spin[k] + torque[a] * with.mobility[r * 2 + 1];
      }
      store(v, rows.v(r));
      drift(rows.x(r), v * in_vector(quanta));
      for (int k = 0; k < stride; k += 4) clear(sums + k);
      speed2 = larger_or_nan(square(v), speed2);
    }
    sweep.speed2 = speed2;
  }

 private:
  /// All but what stands beside them.
  [[gnu::always_inline]] static void clear(Sum* sums) { std::fill_n(sums, 3, Sum{}); }
  [[gnu::always_inline]] static FourDoubles load(const double* from) {
    FourDoubles out;
    std::memcpy(&out, from, sizeof out);
    return out;
  }
  [[gnu::always_inline]] static void store(FourDoubles four, double* to) {
    std::memcpy(to, &four, sizeof four);
  }
  /// A factor that leaves out what stands beside a vector.
  [[gnu::always_inline]] static FourDoubles in_vector(double x) { return FourDoubles{x, x, x, 0}; }
  /// As round_to_quanta() and moved_by().
  [[gnu::always_inline]] static void drift(double* x, FourDoubles way) {
    typedef std::uint64_t Four __attribute__((vector_size(32)));
    Four at;
    std::memcpy(&at, x, sizeof at);
    at += std::bit_cast<Four>(way + rounding_shift) - std::bit_cast<std::uint64_t>(rounding_shift);
    std::memcpy(x, &at, sizeof at);
  }
  [[gnu::always_inline]] static double square(FourDoubles v) {
    const FourDoubles squares = v * v;
    return squares[0] + squares[1] + squares[2];
  }
  [[gnu::always_inline]] static double larger_or_nan(double x, double than) { return x <= than ? than : x; }
};

}  // namespace sph
