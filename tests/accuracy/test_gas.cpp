// Ideal gases: Sod's shock tube, conservation in a blast, sound.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "accuracy/measure.hpp"
#include "accuracy/pinned.hpp"

namespace {

using measure::Sample;

struct Totals {
  double energy = 0, px = 0, py = 0;
};

Totals totals(const sph::Simulation& s) {
  Totals t;
  const double* u = s.particles().data<sph::Field::specific_energy>();
  const std::vector<Sample> all = measure::samples(s);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Sample& q = all[i];
    if (measure::is_wall(s, q)) continue;
    t.energy += q.mass * (u[i] + 0.5 * (q.v[0] * q.v[0] + q.v[1] * q.v[1]));
    t.px += q.mass * q.v[0];
    t.py += q.mass * q.v[1];
  }
  return t;
}

/// As sod.py makes it: equal masses, the jump a tanh as wide as the spacing on the right.
sph::Simulation sod_tube(const decomp::Comm& comm, int n) {
  const int rows = 42, layers = 12;
  const double dx = 1.0 / n, high = 1, low = 0.125, mass = low * dx * dx;
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("peperite_" + std::to_string(getpid()) + ".csv");
  std::ofstream csv(file);
  csv.precision(17);
  csv << "id,x,y,vx,vy,group,rho,mass,u\n";
  const auto sum = [&](double x) {  // int rho dx from 0
    return 0.5 * (high + low) * x - 0.5 * (high - low) * dx * std::log(std::cosh(x / dx));
  };
  int id = 0;
  for (double wanted = (std::ceil(sum(-0.5 - layers * dx) / (low * dx)) + 0.5) * low * dx;
       wanted < sum(0.5 + layers * dx); wanted += low * dx) {
    double below = -0.7, above = 0.7;
    for (int k = 0; k < 50; ++k) {
      const double x = 0.5 * (below + above);
      (sum(x) < wanted ? below : above) = x;
    }
    const double x = below, shape = std::tanh(x / dx);
    const double rho = 0.5 * (high + low) - 0.5 * (high - low) * shape, p = 0.55 - 0.45 * shape;
    for (int k = 0; k < rows; ++k)
      csv << ++id << ',' << x << ',' << (k + 0.5) * dx << ",0,0," << (std::abs(x) > 0.5 ? 1 : 0) << ',' << rho
          << ',' << mass << ',' << p / (0.4 * rho) << '\n';
  }
  csv.close();
  const measure::Removed removed{file};
  return sph::Simulation(
      comm, sph::read_scene(PEPERITE_ACCURACY_DIR "/sod.toml",
                            {"start.file=" + file.string(), "start.spacing=" + std::to_string(dx),
                             "domain.upper=[0.8, " + std::to_string(rows * dx) + "]"}));
}

TEST(Gas, SodsTube) {
  const decomp::Comm comm(MPI_COMM_SELF);
  constexpr int n = 100;
  sph::Simulation s = sod_tube(comm, n);
  const double before = totals(s).energy;
  measure::run_until(s, 0.2);
  // Toro (2009), 4.3.3: between the waves, then the speeds of tail, contact and shock.
  const double p = 0.303130, u = 0.927453, left = 0.426319, right = 0.265574;
  const double t = s.global().time, tail = -0.070273 * t, contact = u * t, shock = 1.752156 * t;
  const auto plateau = [&](double a, double b, double density) {
    double rho = 0, pressure = 0, speed = 0;
    int count = 0;
    for (const Sample& q : measure::samples(s)) {
      if (q.x[0] < a + 0.15 * (b - a) || q.x[0] > b - 0.15 * (b - a)) continue;
      rho += q.rho, pressure += q.p, speed += q.v[0], ++count;
    }
    std::printf("Sod's tube, %d: density %+.2f %%, pressure %+.2f %%, speed %+.2f %%\n", n,
                100 * (rho / count / density - 1), 100 * (pressure / count / p - 1),
                100 * (speed / count / u - 1));
    EXPECT_NEAR(PINNED(rho / count), density, 0.01 * density);
    EXPECT_NEAR(PINNED(pressure / count), p, 0.01 * p);
    EXPECT_NEAR(PINNED(speed / count), u, 0.01 * u);
  };
  plateau(tail, contact, left);
  plateau(contact, shock, right);
  double front = 0;  // of the last particle beyond the middle of the jump
  for (const Sample& q : measure::samples(s))
    if (!measure::is_wall(s, q) && q.rho > 0.5 * (right + 0.125)) front = std::max(front, q.x[0]);
  std::printf("  shock %+.2f dx ahead, energy %+.2e\n", (front - shock) * n, totals(s).energy / before - 1);
  EXPECT_NEAR(PINNED(front), shock, 2.0 / n);
  EXPECT_NEAR(PINNED(totals(s).energy / before), 1, 1e-3);
}

// Two gases, one of them viscous, pressures 20 : 1, all periodic: nothing is lost but to rounding of momenta,
// and of the energy to steps in time.
TEST(Gas, ABlastKeepsMomentumAndEnergy) {
  const decomp::Comm comm(MPI_COMM_SELF);
  for (const double cfl : {0.8, 0.2}) {
    sph::Simulation s(
        comm, sph::read_scene(PEPERITE_TEST_DIR "/scenes/blast2d.toml",
                              {"domain.lower=[0, 0]", "domain.upper=[1, 0.3]", "domain.periodic=[true, true]",
                               "time.cfl=" + std::to_string(cfl)}));
    const Totals before = totals(s);
    measure::run_until(s, 0.3);
    const Totals after = totals(s);
    std::printf("blast, cfl %.1f: energy %+.2e\n", cfl, after.energy / before.energy - 1);
    EXPECT_NEAR(PINNED(after.energy / before.energy), 1, cfl > 0.5 ? 4e-3 : 1e-3);
    EXPECT_NEAR(after.px, before.px, 1e-12);
    EXPECT_NEAR(after.py, before.py, 1e-12);
  }
}

// A gas at rest stays at rest, at walls too.
TEST(Gas, StaysAtRest) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s(comm, sph::read_scene(PEPERITE_TEST_DIR "/scenes/blast2d.toml",
                                          {"group.hot.density=1", "group.hot.start_pressure=0.1",
                                           "start.jitter=0", "start.velocity=[0, 0]"}));
  measure::run_until(s, 1);
  double fastest = 0;
  for (const Sample& q : measure::samples(s)) fastest = std::max(fastest, std::hypot(q.v[0], q.v[1]));
  std::printf("gas at rest for 3 crossings of sound: fastest %.1e of it\n", fastest / std::sqrt(0.14));
  EXPECT_LE(PINNED(fastest), 0.02 * std::sqrt(0.14));
}

// A standing wave swings at sqrt(gamma p / rho), less what the kernel takes of a wave 40 particles long, and
// without viscosity neither fades nor grows: compression is adiabatic.
// What Newtonian viscosity takes from the motion is heat; with a kernel so narrow that the factor of the
// viscous sum is far from 1, and the lattice resists the shear: that is internal energy too.
TEST(Gas, ViscosityHeats) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s(
      comm, sph::read_scene(PEPERITE_ACCURACY_DIR "/taylor_green.toml",
                            {"terms.shifting=", "start.spacing=0.04", "kernel.h_over_dx=0.7",
                             "group.fluid.sound_speed=", "group.fluid.eos=ideal_gas",
                             "group.fluid.heat_ratio=1.4", "group.fluid.start_pressure=20", "start.jitter=0",
                             "group.fluid.viscosity=0.1", "time.cfl=0.1", "terms.artificial_viscosity=0",
                             "terms.quadratic_viscosity=0", "terms.artificial_conduction=0"}));
  const auto kinetic = [&] {
    double sum = 0;
    for (const Sample& q : measure::samples(s)) sum += 0.5 * q.mass * (q.v[0] * q.v[0] + q.v[1] * q.v[1]);
    return sum;
  };
  s.step();
  const double energy = totals(s).energy, motion = kinetic();
  measure::run_until(s, 0.05);
  const double lost = motion - kinetic(), missing = totals(s).energy - energy;
  std::printf("vortices in a viscous gas: %.0f %% of the motion lost, of it not found as heat %+.1e\n",
              100 * lost / motion, -missing / lost);
  EXPECT_GT(PINNED(lost), 0.3 * motion);
  EXPECT_LE(PINNED(std::abs(missing)), 0.005 * lost);
}

TEST(Gas, SoundIsAdiabatic) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Scene scene = sph::read_scene(
      PEPERITE_ACCURACY_DIR "/taylor_green.toml",
      {"terms.shifting=", "start.jitter=0", "start.spacing=0.0125",
       "group.fluid.sound_speed=", "group.fluid.viscosity=0", "group.fluid.eos=ideal_gas",
       "group.fluid.heat_ratio=1.4", "group.fluid.start_pressure=50", "terms.artificial_viscosity=0",
       "terms.quadratic_viscosity=0", "terms.artificial_conduction=0"});
  scene.start.velocity.kind =
      sph::InitialVelocity::rest;  // the pressure alone: a wave along x and one along y
  sph::Simulation s(comm, scene);
  const double k = 4 * std::numbers::pi, c = std::sqrt(1.4 * 50);
  std::vector<double> crossings, peaks{0};
  double before = 0, t0 = 0;
  measure::run_until(s, 4 * 0.5 / c, [&] {
    double amplitude = 0;
    const std::vector<Sample> all = measure::samples(s);
    for (const Sample& q : all) amplitude += (q.p - 50) * std::cos(k * q.x[0]);
    amplitude /= 0.5 * static_cast<double>(all.size());
    const double t = s.global().time;
    if (before * amplitude < 0) {
      crossings.push_back(t0 + (t - t0) * before / (before - amplitude));
      peaks.push_back(0);
    }
    peaks.back() = std::max(peaks.back(), std::abs(amplitude));
    before = amplitude, t0 = t;
  });
  ASSERT_GE(crossings.size(), 7U);
  const double omega =
      std::numbers::pi * static_cast<double>(crossings.size() - 1) / (crossings.back() - crossings.front());
  std::printf("sound in a gas: speed %+.2f %%, amplitude after %zu half swings %+.2f %%\n",
              100 * (omega / (c * k) - 1), crossings.size() - 2,
              100 * (peaks[crossings.size() - 1] / peaks[1] - 1));
  EXPECT_NEAR(PINNED(omega / (c * k)), 1, 0.015);
  EXPECT_NEAR(peaks[crossings.size() - 1] / peaks[1], 1, 0.01);
}

}  // namespace
