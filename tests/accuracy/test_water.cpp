// Water that diffuses in melt which does not move, against exact solutions: decay of a sine, and of the slowest mode of layers
// in which it is carried by liquids of different density and diffusivity.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <random>
#include <string>

#include "accuracy/measure.hpp"
#include "accuracy/pinned.hpp"
#include "sph/output/monitors.hpp"

namespace {

using namespace sph;

constexpr double pressure = 1e6, modulus = 1e7, mean = 0.05, swing = 0.02;
constexpr int across = 12;

/// Nothing comes out of solution.
struct Melt {
  std::string name;
  double density, diffusivity;
  [[nodiscard]] std::string text() const {
    return "[[group]]\nname = \"" + name +
           "\"\nkind = \"fluid\"\neos = \"bubbly\"\ndensity = " + std::to_string(density) +
           "\nbulk_modulus = " + std::to_string(modulus) +
           "\ngas_content = 0.05\ngas_rt = 5e5\nsolubility_pressure = 1e6\nexsolution_time = 1e9\n" +
           "water_diffusivity = " + std::to_string(diffusivity) + "\n";
  }
};

/// A periodic strip along x that is 1 m long; contents are mean + swing phi(x), and M / V even in each melt.
struct Strip {
  int cells;
  double jitter;
  std::vector<Melt> melts;
  std::function<std::size_t(double)> melt;
  std::function<double(double)> phi;
};

Simulation strip(const decomp::Comm& comm, const Strip& s) {
  const measure::Removed made{std::filesystem::temp_directory_path() /
                              ("peperite_water_" + std::to_string(::getpid()) + ".csv")};
  const double dx = 1.0 / s.cells;
  {
    std::ofstream out(made.file);
    out << "id,x,y,vx,vy,group,rho,m\n";
    out.precision(17);
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> shift(-s.jitter, s.jitter);
    for (int k = 0; k < s.cells * across; ++k) {
      const double x = (k / across + 0.5 + shift(random)) * dx, y = (k % across + 0.5 + shift(random)) * dx;
      const Melt& melt = s.melts[s.melt(x)];
      const double m = mean + swing * s.phi(x);
      out << k << ',' << x << ',' << y << ",0,0," << melt.name << ','
          << melt.density * (1 + pressure / modulus) * (1 + m) / (1 + mean) << ',' << m << '\n';
    }
  }
  std::string text = "kernel = { h_over_dx = 1.0 }\n[domain]\nlower = [0, 0]\nupper = [1, " +
                     std::to_string(across * dx) + "]\nperiodic = [true, true]\nsurface_pressure = 1e6\n" +
                     "[terms]\nmotion = false\n";
  for (const Melt& melt : s.melts) text += melt.text();
  text += "[start]\nspacing = " + std::to_string(dx) + "\nfile = \"" + made.file.string() +
          "\"\nfree_surface = false\n[time]\nsteps = 1\n[[monitor]]\nkind = \"budget\"\n";
  return {comm, parse_scene(text, "strip", {})};
}

/// Of phi in what is dissolved, and how far that is from phi alone at most, over the amplitude.
struct Mode {
  double amplitude, error;
};
Mode mode(const Simulation& s, const std::function<double(double)>& phi) {
  const Particles& p = s.particles();
  const double *w = p.data<Field::dissolved_gas>(), *liquid = p.data<Field::liquid_mass>();
  const auto x = [&](std::size_t i) { return s.scale().metres(p.data<Field::position>()[2 * i]); };
  double sum = 0, norm = 0, worst = 0;
  for (std::size_t i = 0; i < p.owned(); ++i) {
    sum += liquid[i] * (w[i] - mean) * phi(x(i));
    norm += liquid[i] * phi(x(i)) * phi(x(i));
  }
  for (std::size_t i = 0; i < p.owned(); ++i)
    worst = std::fmax(worst, std::abs((w[i] - mean) - sum / norm * phi(x(i))));
  return {sum / norm, worst / (sum / norm)};
}

double rate_of_decay(int cells, double jitter) {
  const decomp::Comm comm(MPI_COMM_SELF);
  constexpr double k = 2 * std::numbers::pi;
  const auto phi = [](double x) { return std::sin(k * x); };
  Simulation s = strip(comm, {cells, jitter, {{"melt", 1000, 1}}, [](double) { return 0u; }, phi});
  const Monitors monitors(s);
  const double gas = monitors.values(s)[1];
  const double first = mode(s, phi).amplitude;
  measure::run_until(s, 0.02);
  EXPECT_NEAR(monitors.values(s)[1] / gas, 1, 1e-13);
  return std::log(first / mode(s, phi).amplitude) / s.global().time / (k * k);
}

TEST(Water, SineDecays) {
  EXPECT_NEAR(PINNED(rate_of_decay(40, 0.05)), 1, 0.007);
  const double coarse = PINNED(rate_of_decay(20, 0)), fine = PINNED(rate_of_decay(80, 0));
  EXPECT_GT(std::log2((1 - coarse) / (1 - fine)) / 2, 1.9);  // order
}

// Of two layers, half of the strip each and even about their middles: cosines of k_1 and k_2, D k^2 the same, that meet
// with one value and one flux, rho D k sin of it: r_1 k_1 tan(k_1 / 4) + r_2 k_2 tan(k_2 / 4) = 0, r = rho D.
void look_at_layers(double densities, double diffusivities, double& rate, double& error) {
  const decomp::Comm comm(MPI_COMM_SELF);
  const double flux = densities * diffusivities, slower = 1 / std::sqrt(diffusivities);
  const auto lacks = [&](double k) {
    return std::sin(k / 4) * std::cos(k * slower / 4) +
           flux * slower * std::sin(k * slower / 4) * std::cos(k / 4);
  };
  double k = 2 * std::numbers::pi, high = 4 * std::numbers::pi;  // a quarter to half a wave in the first
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (k + high);
    (lacks(middle) > 0 ? k : high) = middle;
  }
  const auto phi = [=](double x) {
    const double from = std::abs(x - 0.5);
    return from < 0.25 ? std::cos(k * from)
                       : std::cos(k / 4) / std::cos(k * slower / 4) * std::cos(k * slower * (0.5 - from));
  };
  Simulation s = strip(comm, {80,
                              0.05,
                              {{"slow", 100, 1}, {"quick", 100 * densities, diffusivities}},
                              [](double x) { return std::abs(x - 0.5) < 0.25 ? 0u : 1u; },
                              phi});
  const double first = mode(s, phi).amplitude;
  measure::run_until(s, 1 / (k * k));
  const Mode last = mode(s, phi);
  rate = std::log(first / last.amplitude) / s.global().time / (k * k);
  error = last.error;
}

TEST(Water, LayersDiffuseAsTheirMeanSays) {
  for (const double densities : {1.0, 100.0}) {
    double rate = 0, error = 0;
    look_at_layers(densities, 10, rate, error);
    const std::string name = " 1:" + std::to_string(static_cast<int>(10 * densities));
    EXPECT_NEAR(measure::pinned(("rate" + name).c_str(), rate), 1, 0.005);
    EXPECT_LT(measure::pinned(("error" + name).c_str(), error), 0.01);
  }
}

}  // namespace
