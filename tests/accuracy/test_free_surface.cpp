// Flows with a free surface and shifting: the elliptic drop (Monaghan 1994, accuracy.md A10) and the rotating
// square patch (A9), whose pressures are negative and tear it into threads without shifting.
// benchmarks/accuracy has finer runs.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "accuracy/measure.hpp"

namespace {

/// Runs a scene of benchmarks/accuracy from particles at the points of a lattice, n of them along a unit
/// length.
template <class Fluid>
sph::Simulation start(const decomp::Comm& comm, const char* scene, int n, Fluid fluid) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("peperite_" + std::to_string(getpid()) + ".csv");
  {
    std::ofstream csv(file);
    csv.precision(17);
    csv << "id,x,y,vx,vy,group,rho,m\n";
    int id = 0;
    for (int i = -n; i < n; ++i)
      for (int j = -n; j < n; ++j) {
        const double x = (i + 0.5) / n, y = (j + 0.5) / n;
        double vx = 0, vy = 0, rho = 0;
        if (fluid(x, y, vx, vy, rho))
          csv << ++id << ',' << x << ',' << y << ',' << vx << ',' << vy << ",0," << rho << ",0\n";
      }
  }
  sph::Simulation s(
      comm, sph::read_scene(std::string(PEPERITE_ACCURACY_DIR "/") + scene,
                            {"start.file=" + file.string(), "start.spacing=" + std::to_string(1.0 / n)}));
  std::filesystem::remove(file);
  return s;
}

TEST(FreeSurface, EllipticDrop) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s =
      start(comm, "elliptic_drop.toml", 25, [](double x, double y, double& vx, double& vy, double& rho) {
        vx = -100 * x, vy = 100 * y;
        const double r2 = x * x + y * y;
        rho = 1000 + 0.5 * 1000 * 100 * 100 * (1 - r2) / (1400.0 * 1400);
        return r2 < 1;
      });
  const auto axes = [&s](double& a, double& b) {  // an ellipse has mean x^2 = a^2/4
    double xx = 0, yy = 0, n = 0;
    for (const measure::Sample& q : measure::samples(s)) xx += q.x[0] * q.x[0], yy += q.x[1] * q.x[1], ++n;
    a = 2 * std::sqrt(xx / n), b = 2 * std::sqrt(yy / n);
  };
  double a0 = 0, b0 = 0, a = 0, b = 0;
  axes(a0, b0);
  measure::run_until(s, 0.0076);
  axes(a, b);
  std::printf("elliptic drop, R/dx = 25: b %.4f (exact 1.9445), a b %.4f (exact 1)\n", b / b0,
              a * b / (a0 * b0));
  EXPECT_NEAR(b / b0, 1.944517, 0.005 * 1.9445);
  EXPECT_NEAR(a * b / (a0 * b0), 1, 0.015);
}

TEST(FreeSurface, RotatingPatch) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s =
      start(comm, "rotating_patch.toml", 50, [](double x, double y, double& vx, double& vy, double& rho) {
        vx = y, vy = -x;
        rho = 1;
        return std::abs(x) < 0.5 && std::abs(y) < 0.5;
      });
  const auto angular_momentum = [&s] {
    double sum = 0;
    for (const measure::Sample& q : measure::samples(s)) sum += q.mass * (q.x[0] * q.v[1] - q.x[1] * q.v[0]);
    return sum;
  };
  const double before = angular_momentum();
  measure::run_until(s, 2);
  // A particle within 1.3 dx of every point of the middle: no voids.
  const std::vector<measure::Sample> all = measure::samples(s);
  double largest = 0;
  for (double x = -0.2; x <= 0.2; x += 0.01)
    for (double y = -0.2; y <= 0.2; y += 0.01) {
      double nearest = 1;
      for (const measure::Sample& q : all) nearest = std::min(nearest, std::hypot(q.x[0] - x, q.x[1] - y));
      largest = std::max(largest, nearest / 0.02);
    }
  const double after = angular_momentum();
  std::printf(
      "rotating patch, 50 x 50, omega t = 2: angular momentum %.4f of the first, largest gap %.2f dx\n",
      after / before, largest);
  EXPECT_NEAR(after / before, 1, 0.01);
  EXPECT_LE(largest, 1.3);
}

}  // namespace
