// What shifting must not do: depend on the frame of the box, follow particles elsewhere, stir a fluid at
// rest.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>

#include "accuracy/measure.hpp"
#include "accuracy/pinned.hpp"

namespace {

sph::Simulation from_rows(const decomp::Comm& comm, const char* scene, const std::string& rows,
                          std::vector<std::string> overrides) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("peperite_shifting_" + std::to_string(getpid()) + ".csv");
  std::ofstream(file) << "id,x,y,vx,vy,group,rho,m\n" << rows;
  overrides.push_back("start.file=" + file.string());
  const measure::Removed removed{file};
  return sph::Simulation(comm, sph::read_scene(std::string(PEPERITE_ACCURACY_DIR "/") + scene, overrides));
}

std::string row(int id, double x, double y, double vx, double vy, double rho) {
  char text[200];
  std::snprintf(text, sizeof text, "%d,%.17g,%.17g,%.17g,%.17g,0,%.17g,0\n", id, x, y, vx, vy, rho);
  return text;
}

/// Taylor-Green vortices of this speed, c = 10, that drift with a uniform velocity.
sph::Simulation vortices(const decomp::Comm& comm, double drift, double speed) {
  constexpr int n = 50;
  constexpr double k = 2 * std::numbers::pi;
  std::string rows;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = (i + 0.5) / n, y = (j + 0.5) / n;
      // A jitter of +-0.05 dx, without a period that the lattice has.
      const double px = x + 0.05 / n * std::sin(12.9898 * (i * n + j)),
                   py = y + 0.05 / n * std::sin(78.233 * (i * n + j));
      const double p = -0.25 * speed * speed * (std::cos(2 * k * px) + std::cos(2 * k * py));
      rows += row(i * n + j + 1, px, py, drift - speed * std::cos(k * px) * std::sin(k * py),
                  speed * std::sin(k * px) * std::cos(k * py), 1 + p / 100);
    }
  return from_rows(comm, "taylor_green.toml", rows,
                   {"start.region=", "start.velocity=", "start.pressure=", "start.flow_speed=",
                    "start.flow_length=", "start.jitter=", "start.seed="});
}

/// L2 error at t = 1 of those of speed 1.
double drifting_vortices(double drift) {
  constexpr double k = 2 * std::numbers::pi;
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s = vortices(comm, drift, 1);
  measure::run_until(s, 1);
  const double decay = std::exp(-2 * 0.01 * k * k * s.global().time);
  double error2 = 0, norm2 = 0;
  for (const measure::Sample& q : measure::samples(s)) {
    const double x = q.x[0] - drift * s.global().time;
    const double u = -decay * std::cos(k * x) * std::sin(k * q.x[1]);
    const double v = decay * std::sin(k * x) * std::cos(k * q.x[1]);
    error2 += (q.v[0] - drift - u) * (q.v[0] - drift - u) + (q.v[1] - v) * (q.v[1] - v);
    norm2 += u * u + v * v;
  }
  return std::sqrt(error2 / norm2);
}

// With the largest speed of the box for a length it is 3.4 % at 10 U.
TEST(Shifting, IsTheSameInEveryFrame) {
  const double still = drifting_vortices(0);
  for (double drift : {3.0, 10.0}) {
    const double error = drifting_vortices(drift);
    std::printf("Taylor-Green, Re 100, 50 x 50, L2 at t = 1: %.3f %%, drifting with %.0f U %.3f %%\n",
                100 * still, drift, 100 * error);
    EXPECT_NEAR(PINNED(error), still, 0.0005) << drift;
  }
  EXPECT_LE(PINNED(still), 0.008);
}

// However slow the flow in however fast a frame.
TEST(Shifting, KnowsASlowFlowInAFastFrame) {
  const decomp::Comm comm(MPI_COMM_SELF);
  const auto unlike = [&](double drift) {
    sph::Simulation s = vortices(comm, drift, 1e-3);
    s.step();
    return s.global().motion.unlike;
  };
  const double still = unlike(0);
  EXPECT_GT(PINNED(still), 2e-4);
  EXPECT_NEAR(PINNED(unlike(50) / still), 1, 0.01);  // the time step is shorter there
}

/// Of a drop that is drawn out, the half on the left after some steps; one particle on the right may fly.
std::map<std::uint64_t, std::array<double, 2>> left_half(bool with_a_fast_one) {
  constexpr int n = 25;
  std::string rows;
  int id = 0;
  for (int i = -n; i < n; ++i)
    for (int j = -n; j < n; ++j) {
      const double x = (i + 0.5) / n, y = (j + 0.5) / n;
      if (x * x + y * y >= 1) continue;
      const bool fast = with_a_fast_one && i == n - 1 && j == 0;
      // Disordered, so that there is something to shift.
      const double px = x + 0.1 / n * std::sin(12.9898 * (i * n + j)),
                   py = y + 0.1 / n * std::sin(78.233 * (i * n + j));
      rows += row(++id, px, py, fast ? 4000 : -40 * px, 40 * py, 1000);
    }
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s =
      from_rows(comm, "elliptic_drop.toml", rows, {"start.spacing=0.04", "time.cfl=", "time.dt=2e-6"});
  for (int k = 0; k < 10; ++k) s.step();
  std::map<std::uint64_t, std::array<double, 2>> positions;
  for (std::size_t i = 0; i < s.particles().owned(); ++i) {
    const measure::Sample q = measure::samples(s)[i];
    if (q.x[0] < 0) positions[s.particles().data<sph::Field::id>()[i]] = {q.x[0], q.x[1]};
  }
  return positions;
}

// With the largest speed for a length 0.27 of a spacing. What is left is what the one has of the mean
// velocity and, as one at c / 10, of the eighth mean.
TEST(Shifting, OneFastParticleStirsNoOther) {
  const auto with = left_half(true), without = left_half(false);
  ASSERT_GT(without.size(), 900u);
  ASSERT_EQ(with.size(), without.size());
  double largest = 0;
  for (const auto& [id, x] : without)
    for (std::size_t a = 0; a < 2; ++a) largest = std::max(largest, std::abs(with.at(id)[a] - x[a]));
  std::printf(
      "one particle at 100 times the speed of 1,975 others moves those of the other half by %.1e dx\n",
      largest / 0.04);
  EXPECT_LE(PINNED(largest), 0.01 * 0.04);
}

// With the largest speed for a length 3e-4.
TEST(Shifting, LeavesATankAtRest) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s(
      comm, sph::read_scene(PEPERITE_ACCURACY_DIR "/hydrostatic.toml",
                            {"start.spacing=0.04", "start.lower=[-0.16, -0.16]", "start.upper=[1.16, 1.16]",
                             "start.region.2.upper=[1, 1.2]", "terms.shifting=true"}));
  double largest = 0;
  measure::run_until(s, *s.scene().time.until, [&] {
    if (s.global().step % 20 != 0) return;
    double kinetic = 0, mass = 0;
    for (const measure::Sample& q : measure::samples(s)) {
      if (measure::is_wall(s, q)) continue;
      kinetic += 0.5 * q.mass * (q.v[0] * q.v[0] + q.v[1] * q.v[1]);
      mass += q.mass;
    }
    largest = std::max(largest, kinetic / (mass * 9.8));
  });
  std::printf("tank with shifting, H/dx = 25: kinetic energy <= %.1e MgH\n", largest);
  EXPECT_LE(largest, 2e-6);
}

}  // namespace
