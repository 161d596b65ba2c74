// Inlets and outlets: a channel between them, the wave that leaves, the budget, a jet that leaves the domain.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "accuracy/measure.hpp"
#include "accuracy/pinned.hpp"
#include "sph/output/monitors.hpp"

namespace {

using measure::Sample, measure::samples, measure::run_until;

sph::Simulation open_scene(const decomp::Comm& comm, const std::string& name,
                           const std::vector<std::string>& overrides = {}) {
  return sph::Simulation(comm, sph::read_scene(std::string(PEPERITE_ACCURACY_DIR "/") + name, overrides));
}

double column(sph::Simulation& s, const std::string& name) {
  const sph::Monitors monitors(s);
  const std::vector<double> row = monitors.values(s);
  const auto at = std::ranges::find(monitors.names(), name);
  return row.at(static_cast<std::size_t>(at - monitors.names().begin()));
}

/// Of the fluid between the boxes, over the largest speed of the parabola.
struct ChannelErrors {
  double largest = 0, mean = 0, pressure = 0;
};
ChannelErrors channel_errors(const sph::Simulation& s) {
  constexpr double fastest = 1.5, slope = 12 * 0.2, length = 2;
  ChannelErrors out;
  double count = 0, pressure = 0, along = 0;
  for (const Sample& q : samples(s)) {
    if (measure::is_wall(s, q) || q.x[0] < 0 || q.x[0] >= length) continue;
    const double error = (q.v[0] - 6 * q.x[1] * (1 - q.x[1])) / fastest;
    out.largest = std::fmax(out.largest, std::fabs(error));
    out.mean += error;
    ++count;
    const double x = q.x[0] - 0.5 * length;
    pressure += x * q.p;
    along += x * x;
  }
  out.mean /= count;
  out.pressure = -pressure / along / slope - 1;
  return out;
}

// A parabola comes in, or a plug that becomes one (not measured near it).
TEST(Open, PoiseuilleBetweenInletAndOutlet) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s = open_scene(comm, "poiseuille_open.toml");
  const double mass = column(s, "budget_mass");
  double largest = 0, mean = 0, gradient = 0, worst_budget = 0;
  int seen = 0;
  run_until(s, 6, [&] {
    if (s.global().time < 4 || s.global().step % 50 != 0) return;
    const ChannelErrors errors = channel_errors(s);
    largest = std::fmax(largest, errors.largest);
    mean += errors.mean;
    gradient += errors.pressure;
    ++seen;
    const double lost =
        column(s, "budget_mass") - column(s, "budget_mass_in") + column(s, "budget_mass_out") - mass;
    worst_budget = std::fmax(worst_budget, std::fabs(lost) / mass);
  });
  mean = std::fabs(mean / seen);
  gradient = std::fabs(gradient / seen);
  std::printf(
      "Poiseuille through openings: largest error %.3f %% of u_max, mean %.3f %%, gradient %.3f %%, budget "
      "%.1e\n",
      100 * largest, 100 * mean, 100 * gradient, worst_budget);
  EXPECT_LE(PINNED(largest), 0.01);
  EXPECT_LE(PINNED(mean), 0.003);
  EXPECT_LE(PINNED(gradient), 0.01);
  EXPECT_LE(worst_budget, 1e-12);
}

/// Largest mean pressure, of either sign, in a slice of the channel between two times.
double strongest(sph::Simulation& s, double from, double until) {
  double largest = 0;
  run_until(s, from);
  run_until(s, until, [&] {
    double sum = 0, count = 0;
    for (const Sample& q : samples(s))
      if (q.x[0] >= 4 && q.x[0] < 4.2) sum += q.p, ++count;
    largest = std::fmax(largest, std::fabs(sum / count));
  });
  return largest;
}

// The pulse passes 4.1 m from 0.4 to 0.7 s; what the outlet throws back from 0.8 to 1.1 s.
TEST(Open, WavesLeave) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s = open_scene(comm, "open_wave.toml");
  const double there = strongest(s, 0.35, 0.72), back = strongest(s, 0.78, 1.15);
  const double slow = 10 * 1000 * 0.0655;  // rho c v
  std::printf("a pulse of %.4f rho c v comes to an outlet, %.4f of that back\n", there / slow, back / there);
  EXPECT_GE(PINNED(there / slow), 0.9);  // diffusion of the density damps it on its way
  EXPECT_LE(PINNED(back / there), 0.05);
}

// A jet against gravity leaves through the roof, comes down on the floor's drain and through the sides: the run goes on.
TEST(Open, AJetLeavesAndTheRunGoesOn) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s = open_scene(comm, "open_jet.toml");
  const double mass = column(s, "budget_mass");
  run_until(s, 3);
  const double in = column(s, "budget_mass_in"), out = column(s, "budget_mass_out");
  std::printf("a jet: %.4f of it came in, %.4f of that left\n", in / (5 * 0.2 * 1000 * 3), out / in);
  EXPECT_NEAR(PINNED(in / (5 * 0.2 * 1000 * 3)), 1, 0.01);
  EXPECT_GT(PINNED(out / in), 0.5);
  EXPECT_NEAR(column(s, "budget_mass") - in + out, mass, 1e-12 * in);
}

}  // namespace
