// Start-up of Poiseuille and Couette flow between two walls (Morris et al. 1997; accuracy.md A1, A2): within
// 1 % of the largest speed everywhere at L/dx = 20; order >= 1.7 from 20 to 40 in Poiseuille (the suite: to
// 80). With the walls' mirror of Adami et al., k = 1, the errors are 0.41, 0.13, 0.043 %.
#include <gtest/gtest.h>

#include "accuracy/measure.hpp"
#include "accuracy/pinned.hpp"

namespace {

constexpr double length = 1e-3, viscosity = 1e-6, force = 1e-4, lid = 12.5e-6;
constexpr double pi = std::numbers::pi;

double poiseuille(double y, double t) {
  double u = force / (2 * viscosity) * y * (length - y);
  for (int n = 0; n < 200; ++n) {
    const double k = (2 * n + 1) * pi / length;
    u -= 4 * force * length * length / (viscosity * std::pow(pi * (2 * n + 1), 3)) * std::sin(k * y) *
         std::exp(-viscosity * k * k * t);
  }
  return u;
}

double couette(double y, double t) {
  double u = lid * y / length;
  for (int n = 1; n < 200; ++n) {
    const double k = n * pi / length;
    u += 2 * lid / (n * pi) * (n % 2 == 0 ? 1 : -1) * std::sin(k * y) * std::exp(-viscosity * k * k * t);
  }
  return u;
}

/// Largest |u - u_exact| / u_max over all fluid particles and the given times.
template <class Exact>
double worst_error(const char* scene, const std::vector<std::string>& overrides,
                   const std::vector<double>& times, Exact exact) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s(comm, sph::read_scene(std::string(PEPERITE_ACCURACY_DIR "/") + scene, overrides));
  double worst = 0;
  for (double t : times) {
    measure::run_until(s, t);
    double largest = 0;
    for (const measure::Sample& q : measure::samples(s))
      if (!measure::is_wall(s, q))
        largest = std::max(largest, std::abs(q.v[0] - exact(q.x[1], s.global().time)));
    worst = std::max(worst, largest / lid);
    std::printf("%s t = %.4f s: largest error %.3f %% of u_max\n", scene, s.global().time,
                100 * largest / lid);
  }
  return worst;
}

TEST(Channel, AnalyticSeriesAgreeWithThePublishedValues) {
  EXPECT_NEAR(poiseuille(length / 2, 0.0225), 2.232738e-6, 1e-11);
  EXPECT_NEAR(poiseuille(length / 4, 0.225), 8.384910e-6, 1e-11);
  EXPECT_NEAR(couette(length / 2, 0.045) / lid, 0.09558, 1e-5);
}

TEST(Channel, Poiseuille) {
  const std::vector<double> times{0.0225, 0.045, 0.1125, 0.225, 1.0};
  const double coarse = worst_error("poiseuille.toml", {}, times, poiseuille);
  EXPECT_LE(PINNED(coarse), 0.0035);
  const double fine = worst_error("poiseuille.toml", {"start.spacing=25e-6", "time.dt=62.5e-6"},
                                  {0.0225, 0.045, 0.1125}, poiseuille);
  std::printf("Poiseuille 20 -> 40: order %.2f\n", std::log2(coarse / fine));
  EXPECT_LE(PINNED(fine), 0.00095);
  EXPECT_GE(PINNED(std::log2(coarse / fine)), 1.8);
}

// Central forces: with the weight of Monaghan (2005, eq. 4.14), whose fourth moments a lattice does not have,
// 20 % off.
TEST(Channel, PoiseuilleWithSymmetricViscosity) {
  EXPECT_LE(PINNED(worst_error("poiseuille.toml", {"terms.viscosity=symmetric"}, {0.0225, 0.1125, 1.0},
                               poiseuille)),
            0.0035);
}

// Viscous forces of the end of the step, at 16 and 32 times the explicit limit of the step: exact in the end,
// because a flow that no longer changes does not know of steps.
TEST(Channel, PoiseuilleImplicit) {
  const std::vector<std::string> implicit{"terms.implicit_viscosity=true", "time.dt=", "time.cfl=0.8"};
  std::vector<std::string> finer = implicit;
  finer.emplace_back("start.spacing=25e-6");
  const double coarse = worst_error("poiseuille.toml", implicit, {1.0}, poiseuille);
  const double fine = worst_error("poiseuille.toml", finer, {1.0}, poiseuille);
  std::printf("Poiseuille, implicit, 20 -> 40: order %.2f\n", std::log2(coarse / fine));
  EXPECT_LE(PINNED(coarse), 0.0035);
  EXPECT_GE(PINNED(std::log2(coarse / fine)), 1.9);
}

TEST(Channel, Couette) {
  EXPECT_LE(PINNED(worst_error("couette.toml", {}, {0.045, 0.1125, 0.225, 1.0}, couette)), 0.002);
  // At the viscous limit of the time step, nu dt = 0.125 h^2.
  EXPECT_LE(PINNED(worst_error("couette.toml", {"time.dt="}, {0.045, 0.225, 1.0}, couette)), 0.002);
  EXPECT_LE(PINNED(worst_error("couette.toml", {"precision=mixed"}, {0.045, 0.225, 1.0}, couette)), 0.002);
}

// A plug that slips past its walls keeps its speed; of one that sticks to them 0.11 is left in
// the mean after 0.2 L^2 / nu: sum over odd n of 8 / (pi n)^2 exp(-nu (pi n / L)^2 t).
TEST(Channel, PlugPastWallsThatSlip) {
  const auto speeds = [](const std::vector<std::string>& more, double& least, double& mean) {
    std::vector<std::string> overrides{"domain.gravity=", "start.velocity=[12.5e-6, 0]", "terms.shifting="};
    overrides.insert(overrides.end(), more.begin(), more.end());
    const decomp::Comm comm(MPI_COMM_SELF);
    sph::Simulation s(comm, sph::read_scene(PEPERITE_ACCURACY_DIR "/poiseuille.toml", overrides));
    measure::run_until(s, 0.2);
    least = 1, mean = 0;
    int n = 0;
    for (const measure::Sample& q : measure::samples(s))
      if (!measure::is_wall(s, q)) least = std::min(least, q.v[0] / lid), mean += q.v[0] / lid, ++n;
    mean /= n;
  };
  double least = 0, mean = 0;
  speeds({"group.wall.slip=true"}, least, mean);
  std::printf("plug between walls that slip: speed >= 1 - %.1e of the first\n", 1 - least);
  EXPECT_NEAR(least, 1, 1e-6);  // rows that slide past rows of wall feel them through the pressure
  EXPECT_NEAR(mean, 1, 1e-6);
  speeds({}, least, mean);
  double expected = 0;
  for (int n = 1; n < 400; n += 2)
    expected += 8 / (pi * pi * n * n) * std::exp(-viscosity * n * n * pi * pi * 0.2 / (length * length));
  std::printf("no-slip: mean speed %.4f of the first, exact %.4f\n", mean, expected);
  EXPECT_NEAR(PINNED(mean), expected, 0.001);
}

}  // namespace
