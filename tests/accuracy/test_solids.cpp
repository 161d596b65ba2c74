// Total-Lagrangian solids (accuracy.md B): cantilever (B1), colliding rings (B2), spinning plate (B5), wave
// in a bar (B6), a layer under its own weight (B8). benchmarks/accuracy has finer runs of the same scenes.
#include <gtest/gtest.h>

#include "accuracy/bodies.hpp"
#include "accuracy/pinned.hpp"

namespace {

using measure::Bodies, measure::Sample, measure::samples, measure::run_until;
using sph::Field;

double angular_momentum(const sph::Simulation& s) {
  double sum = 0;
  for (const Sample& q : samples(s)) sum += q.mass * (q.x[0] * q.v[1] - q.x[1] * q.v[0]);
  return sum;
}

/// Kinetic and elastic energy of a scene without gravity; clamps are strained too.
double energy(const sph::Simulation& s) {
  double sum = 0;
  for (const Sample& q : samples(s)) {
    if (measure::is_wall(s, q)) continue;
    for (double v : q.v) sum += 0.5 * q.mass * v * v;
  }
  const double* strain = s.particles().data<Field::strain_energy>();
  for (std::size_t i = 0; i < s.particles().owned(); ++i) sum += strain[i];
  return sum;
}

/// The largest departure of a sum from its first value.
class Change {
 public:
  void see(double value) {
    if (first_ == 0) first_ = value;
    largest_ = std::max(largest_, std::abs(value / first_ - 1));
  }
  [[nodiscard]] double largest() const { return largest_; }

 private:
  double first_ = 0, largest_ = 0;
};

/// cauchy stress of particle i: xx, yy, xy
std::array<double, 3> stress_of(const sph::Simulation& s, std::size_t i) {
  const double* d = s.particles().data<Field::stress>() + 3 * i;
  const double p = s.particles().data<Field::pressure>()[i];
  return {d[0] - p, d[1] - p, d[2]};
}

constexpr double c0 = 57.027, height = 0.02, length = 0.2, timoshenko = 0.25647;

double first_mode(double x) {
  const double kl = 1.875, m = std::sin(kl) + std::sinh(kl), n = std::cos(kl) + std::cosh(kl);
  const auto shape = [&](double a) {
    return m * (std::cos(a) - std::cosh(a)) - n * (std::sin(a) - std::sinh(a));
  };
  return shape(kl * x / length) / shape(kl);
}

struct Swing {
  double period = 0;                 ///< over Timoshenko's, less 1
  double amplitude = 0, energy = 0;  ///< last over first, and its largest change
};

/// `n` particles across; the tip starts from its middle position upwards at `speed` c0.
Swing cantilever(int n, double speed, double until) {
  const decomp::Comm comm(MPI_COMM_SELF);
  const double dx = height / n;
  Bodies plate(1000);
  std::size_t tip = 0, count = 0;
  for (int i = -5; i < 10 * n; ++i)
    for (int j = 0; j < n; ++j, ++count) {
      const double x = (i + 0.5) * dx;
      plate.add(x, (j + 0.5) * dx - height / 2, 0, x > 0 ? speed * c0 * first_mode(x) : 0, x > 0 ? 0 : 1);
      if (i == 10 * n - 1 && j == n / 2) tip = count + 1;
    }
  sph::Simulation s = plate.start(comm, "cantilever.toml", dx);
  std::vector<double> t, y;
  Change change;
  run_until(s, until, [&] {
    if (s.global().step % 20 != 0) return;
    const std::uint64_t* id = s.particles().data<Field::id>();
    const std::size_t row = static_cast<std::size_t>(std::find(id, id + s.particles().owned(), tip) - id);
    t.push_back(s.global().time);
    y.push_back(s.scale().metres(s.particles().data<Field::position>()[row * 2 + 1]) - dx / 2);
    change.see(energy(s));
  });
  std::vector<double> crossings;
  for (std::size_t k = 1; k < y.size(); ++k)
    if ((y[k - 1] < 0) != (y[k] < 0))
      crossings.push_back(t[k - 1] - y[k - 1] * (t[k] - t[k - 1]) / (y[k] - y[k - 1]));
  const auto high = [&](double from) {
    double most = 0;
    for (std::size_t k = 0; k < y.size(); ++k)
      if (t[k] >= from && t[k] < from + timoshenko) most = std::max(most, std::abs(y[k]));
    return most;
  };
  const double period =
      2 * (crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1);
  const Swing out{period / timoshenko - 1, high(until - timoshenko) / high(0), change.largest()};
  std::printf("cantilever, %d across, V_f %.2f: T %+.2f %%, amplitude %.4f, energy %.1e\n", n, speed,
              100 * out.period, out.amplitude, out.energy);
  return out;
}

TEST(Solids, CantileverTenPeriods) {
  const Swing s = cantilever(10, 0.01, 10.2 * timoshenko);
  EXPECT_NEAR(PINNED(s.period), 0, 0.015);
  EXPECT_NEAR(PINNED(s.amplitude), 1, 0.005);
  EXPECT_LE(PINNED(s.energy), 1e-3);
}
TEST(Solids, CantileverFar) {
  const Swing s = cantilever(10, 0.05, 2.1 * timoshenko);
  EXPECT_NEAR(PINNED(s.period), 0, 0.015);
  EXPECT_LE(PINNED(s.energy), 1e-3);
}
TEST(Solids, CantileverFine) { EXPECT_NEAR(cantilever(20, 0.01, 1.1 * timoshenko).period, 0, 0.005); }

void collide(double speed) {
  const decomp::Comm comm(MPI_COMM_SELF);
  constexpr int n = 10;
  const double dx = 0.01 / n, c = std::sqrt(1.6260162601626016e7 / 1200);
  Bodies rings(1200);
  for (int side : {0, 1})
    for (int i = -4 * n; i < 4 * n; ++i)
      for (int j = -4 * n; j < 4 * n; ++j) {
        const double x = (i + 0.5) * dx, y = (j + 0.5) * dx, r = std::hypot(x, y);
        if (r > 0.03 && r < 0.04)
          rings.add(x + (side == 0 ? -1 : 1) * (0.04 + dx), y, (side == 0 ? 1 : -1) * speed * c, 0, side);
      }
  sph::Simulation s = rings.start(comm, "rings.toml", dx);
  std::vector<std::array<std::size_t, 2>> neighbours;  // by id - 1
  const std::vector<Sample> first = samples(s);
  const auto ids = [&] { return s.particles().data<Field::id>(); };
  for (std::size_t i = 0; i < first.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (first[i].group == first[j].group &&
          std::hypot(first[i].x[0] - first[j].x[0], first[i].x[1] - first[j].x[1]) < 1.01 * dx)
        neighbours.push_back({ids()[i] - 1, ids()[j] - 1});
  const auto right = [&] {
    double v = 0, m = 0;
    for (const Sample& q : samples(s))
      if (q.group == 1) v += q.mass * q.v[0], m += q.mass;
    return v / m;
  };
  Change change;
  double gap = 0, momentum = 0, strained = 0;
  const double before = right();
  run_until(s, 0.016, [&] {
    if (s.global().step % 20 != 0) return;
    change.see(energy(s));
    std::vector<Sample> now(first.size());
    double p = 0, all = 0, kinetic = 0;
    const std::vector<Sample> rows = samples(s);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      now[ids()[i] - 1] = rows[i];
      p += rows[i].mass * rows[i].v[0];
      all += rows[i].mass * speed * c;
      kinetic += 0.5 * rows[i].mass * (rows[i].v[0] * rows[i].v[0] + rows[i].v[1] * rows[i].v[1]);
    }
    for (const auto& [a, b] : neighbours)
      gap = std::max(gap, std::hypot(now[a].x[0] - now[b].x[0], now[a].x[1] - now[b].x[1]) / dx);
    momentum = std::max(momentum, std::abs(p) / all);
    strained = std::max(strained, 1 - kinetic / energy(s));
  });
  double turning = 0, scale = 0;
  for (const Sample& q : samples(s)) {
    turning += q.mass * (q.x[0] * q.v[1] - q.x[1] * q.v[0]);
    scale += q.mass * speed * c * 0.04;
  }
  std::printf(
      "rings at %.3f c0: energy %.1e, momentum %.1e, angular momentum %.1e, gap %.2f dx, rebound %.2f, "
      "elastic "
      "share %.2f\n",
      speed, change.largest(), momentum, std::abs(turning / scale), gap, -right() / before, strained);
  EXPECT_LE(PINNED(change.largest()), 0.01);
  EXPECT_LE(momentum, 1e-12);
  EXPECT_LE(std::abs(turning / scale), 1e-12);
  EXPECT_LE(PINNED(gap), 1.4);
  EXPECT_GE(PINNED(-right() / before), 0.7);
  EXPECT_GE(PINNED(strained), 0.8);
}
TEST(Solids, CollidingRings) {
  collide(0.059);
  collide(0.08);
}

TEST(Solids, SpinningPlate) {
  const decomp::Comm comm(MPI_COMM_SELF);
  constexpr int n = 20;
  Bodies plate(1100);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = (i + 0.5) / n - 0.5, y = (j + 0.5) / n - 0.5;
      plate.add(x, y, -50 * y, 50 * x);
    }
  sph::Simulation s = plate.start(comm, "spinning_plate.toml", 1.0 / n);
  Change spin, total;
  run_until(s, 10 * 2 * std::numbers::pi / 50, [&] {
    spin.see(angular_momentum(s));
    total.see(energy(s));
  });
  std::printf("spinning plate, 10 turns: angular momentum %.1e, energy %.1e\n", spin.largest(),
              total.largest());
  EXPECT_LE(spin.largest(), 1e-12);
  EXPECT_LE(PINNED(total.largest()), 2e-3);
}

TEST(Solids, BarWave) {
  const decomp::Comm comm(MPI_COMM_SELF);
  constexpr int n = 200, across = 16;
  const double c = std::sqrt(15000.0), v0 = 1e-3 * c;
  Bodies bar(1000);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < across; ++j) {
      const double x = (i + 0.5) / n, u = (x - 0.5) / 0.04;
      bar.add(x, (j + 0.5) / n, v0 * std::exp(-0.5 * u * u), 0);
    }
  sph::Simulation s = bar.start(comm, "bar_wave.toml", 1.0 / n, {"domain.upper=[1.2, 0.08]"});
  // Mean velocity of a slice over time, and its highest point.
  struct Peak {
    double x, time = 0, speed = 0;
  };
  std::vector<Peak> peaks{{0.66 + 0.5 / n}, {0.84 + 0.5 / n}, {1 - 0.5 / n}};
  std::vector<std::vector<double>> speeds(3);
  std::vector<double> times;
  run_until(s, 0.0062, [&] {
    times.push_back(s.global().time);
    const std::vector<Sample> all = samples(s);
    for (std::size_t k = 0; k < 3; ++k) {
      double sum = 0;
      for (const Sample& q : all)
        if (std::abs(q.x[0] - peaks[k].x) < 0.4 / n) sum += q.v[0] / across;
      speeds[k].push_back(sum);
    }
  });
  for (std::size_t k = 0; k < 3; ++k) {
    std::size_t top = 1;
    for (std::size_t t = 1; t + 1 < times.size() && (k == 2 || times[t] < 0.42 / c); ++t)
      if (speeds[k][t] > speeds[k][top]) top = t;
    const double a = speeds[k][top - 1], b = speeds[k][top], d = speeds[k][top + 1];
    const double shift = 0.5 * (a - d) / (a - 2 * b + d);
    peaks[k].time = times[top] + shift * (times[top] - times[top - 1]);
    peaks[k].speed = b - 0.25 * (a - d) * shift;
  }
  const double speed = (peaks[1].x - peaks[0].x) / (peaks[1].time - peaks[0].time);
  std::printf("bar wave, %d along: speed %.4f of c_p, free end %.3f of the pulse\n", n, speed / c,
              peaks[2].speed / peaks[1].speed);
  EXPECT_NEAR(PINNED(speed / c), 1, 0.01);
  EXPECT_NEAR(PINNED(peaks[2].speed / peaks[1].speed), 2, 0.06);
}

TEST(Solids, LayerUnderItsWeight) {
  const decomp::Comm comm(MPI_COMM_SELF);
  constexpr int n = 20, across = 16;
  Bodies layer(2000);
  for (int i = 0; i < across; ++i)
    for (int j = -5; j < n; ++j) layer.add((i + 0.5) / n, (j + 0.5) / n, 0, 0, j < 0 ? 1 : 0);
  sph::Simulation s = layer.start(comm, "gravity_patch.toml", 1.0 / n);
  run_until(s, 1);
  const auto heights = [&] {
    double sum = 0;
    for (const Sample& q : samples(s)) sum += q.x[1];
    return sum;
  };
  const double settled = heights();
  run_until(s, 1 + 100 / std::sqrt(9000.0));
  const double weight = 2000 * 9.81;
  double vertical = 0, ratio = 0, kinetic = 0, mass = 0, sag = 0;
  const std::vector<Sample> all = samples(s);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (measure::is_wall(s, all[i])) continue;
    sag += s.scale().metres(s.particles().data<Field::displacement>()[2 * i + 1]);
    kinetic += 0.5 * all[i].mass * all[i].v[1] * all[i].v[1];
    mass += all[i].mass;
    if (std::abs(all[i].x[1] - 0.5) > 0.4) continue;
    const auto stress = stress_of(s, i);
    vertical = std::max(vertical, std::abs(stress[1] + weight * (1 - all[i].x[1])) / weight);
    ratio = std::max(ratio, std::abs(stress[0] - stress[1] / 3) / weight);
  }
  std::printf("layer under its weight: sigma_yy %.1e, sigma_xx %.1e of rho g H; drift %.1e of the sag\n",
              vertical, ratio, std::abs((heights() - settled) / sag));
  EXPECT_LE(PINNED(vertical), 0.005);
  EXPECT_LE(PINNED(ratio), 0.005);
  EXPECT_LE(kinetic, 1e-12 * mass * 9.81);
  EXPECT_LE(PINNED(std::abs((heights() - settled) / sag)), 1e-4);
}

}  // namespace
