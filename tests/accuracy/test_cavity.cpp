// Lid-driven cavity, Re = 100, 25 x 25: within 2 % of U of Ghia et al. (1982) on the centre lines
// (accuracy.md A4 asks that at 50 x 50, which benchmarks/accuracy runs), no particle through the walls, no
// drift of the mean pressure. A flow of so few particles is chaotic: the largest errors of ten starts alone are 1.2 to
// 1.9 %, so the mean is over four.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <string>

#include "accuracy/measure.hpp"
#include "accuracy/pinned.hpp"

namespace {

/// Velocity at a point by moving least squares of first order, weight exp(-r^2 / 2 h^2).
std::array<double, 2> velocity_at(const std::vector<measure::Sample>& fluid, double x, double y, double h) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
  for (const measure::Sample& q : fluid) {
    const Eigen::Vector3d basis(1, (q.x[0] - x) / h, (q.x[1] - y) / h);
    const double r2 = basis[1] * basis[1] + basis[2] * basis[2];
    if (r2 > 9) continue;
    const double weight = std::exp(-0.5 * r2);
    matrix += weight * basis * basis.transpose();
    right += weight * basis * Eigen::RowVector2d(q.v[0], q.v[1]);
  }
  const Eigen::Matrix<double, 3, 2> fit = matrix.ldlt().solve(right);
  return {fit(0, 0), fit(0, 1)};
}

TEST(LidDrivenCavity, Reynolds100) {
  struct Point {
    double x, y;
    int axis;
    double value;
  };
  constexpr std::array<Point, 8> ghia{{{0.5, 0.1719, 0, -0.10150},
                                       {0.5, 0.2813, 0, -0.15662},
                                       {0.5, 0.4531, 0, -0.21090},
                                       {0.5, 0.7344, 0, 0.00332},
                                       {0.5, 0.8516, 0, 0.23151},
                                       {0.2344, 0.5, 1, 0.17527},
                                       {0.5, 0.5, 1, 0.05454},
                                       {0.8047, 0.5, 1, -0.24533}}};
  constexpr double dx = 0.04;
  const decomp::Comm comm(MPI_COMM_SELF);
  std::array<double, ghia.size()> mean{};
  constexpr int starts = 4, times = 20;
  for (int seed = 1; seed <= starts; ++seed) {
    sph::Simulation s(
        comm, sph::read_scene(PEPERITE_ACCURACY_DIR "/cavity.toml",
                              {"start.spacing=0.04", "start.lower=[-0.12, -0.12]", "start.upper=[1.12, 1.12]",
                               "start.seed=" + std::to_string(seed)}));
    for (int k = 0; k < times; ++k) {
      measure::run_until(s, 15 + 0.25 * k);
      std::vector<measure::Sample> fluid;
      double pressure = 0;
      for (const measure::Sample& q : measure::samples(s)) {
        if (measure::is_wall(s, q)) continue;
        fluid.push_back(q);
        pressure += q.p;
        EXPECT_TRUE(q.x[0] > 0 && q.x[0] < 1 && q.x[1] > 0 && q.x[1] < 1);
      }
      EXPECT_EQ(fluid.size(), 625);
      EXPECT_LE(std::abs(pressure / static_cast<double>(fluid.size())), 0.02);
      for (std::size_t n = 0; n < ghia.size(); ++n)
        mean[n] += velocity_at(fluid, ghia[n].x, ghia[n].y, dx)[static_cast<std::size_t>(ghia[n].axis)] /
                   (starts * times);
    }
  }
  double worst = 0;
  for (std::size_t n = 0; n < ghia.size(); ++n) {
    EXPECT_NEAR(PINNED(mean[n]), ghia[n].value, 0.02) << ghia[n].x << ' ' << ghia[n].y;
    worst = std::max(worst, std::abs(mean[n] - ghia[n].value));
  }
  PINNED(worst);
  std::printf("cavity, Re 100, 25 x 25: largest error %.2f %% of U\n", 100 * worst);
}

}  // namespace
