// Gas that flows through magma that does not move, against exact solutions: a spot that spreads into empty rock
// (Barenblatt 1952), a steady flow between two pressures, loss through a free surface (Terzaghi).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <random>

#include "accuracy/measure.hpp"
#include "accuracy/pinned.hpp"
#include "sph/laws/eos/bubbly.hpp"
#include "sph/output/monitors.hpp"

namespace {

using namespace sph;

constexpr double psi = 0.5, rt = 5e5, liquid = 1000;

/// Bubbly magma whose liquid is stiff and dissolves next to nothing, so that the pressure is linear in its gas.
const std::string foam =
    "[[group]]\nname = \"foam\"\nkind = \"fluid\"\neos = \"bubbly\"\ndensity = 1000\nbulk_modulus = 1e13\n"
    "gas_content = 1e-3\ngas_rt = 5e5\nsolubility_pressure = 1e10\nsolubility_exponent = 2\n";

struct Point {
  double x, y;
  const char* group;
  double pressure;  ///< absolute [Pa]
};

struct Box {
  std::string domain, groups;
  double spacing, surface_pressure = 0;
  bool surface = false;
  std::vector<std::string> set{};
};

Simulation filled(const decomp::Comm& comm, const Box& box, const std::vector<Point>& points) {
  const measure::Removed made{std::filesystem::temp_directory_path() /
                              ("peperite_gas_flow_" + std::to_string(::getpid()) + ".csv")};
  {
    std::ofstream out(made.file);
    out << "id,x,y,vx,vy,group,rho,m\n";
    out.precision(17);
    int id = 0;
    for (const Point& p : points) {
      // Gas fills the share psi: m liquid (1 - psi) RT = p psi.
      const double m = p.pressure * psi / (rt * liquid * (1 - psi));
      out << id++ << ',' << p.x << ',' << p.y << ",0,0," << p.group << ',' << liquid * (1 - psi) * (1 + m)
          << ',' << m << '\n';
    }
  }
  std::string text = "kernel = { h_over_dx = 1.0 }\n[domain]\n" + box.domain +
                     "\nsurface_pressure = " + std::to_string(box.surface_pressure) +
                     "\n[terms]\nmotion = false\n" + box.groups +
                     "[start]\nspacing = " + std::to_string(box.spacing) + "\nfile = \"" +
                     made.file.string() + "\"\nfree_surface = " + (box.surface ? "true" : "false") +
                     "\n[time]\nsteps = 1\n[[monitor]]\nkind = \"budget\"\n";
  return {comm, parse_scene(text, "box", box.set)};
}

std::string permeable(double coefficient) {
  return "permeability = { law = \"power\", coefficient = " + std::to_string(coefficient * 1e12) +
         "e-12, exponent = 1, gas_viscosity = 2e-5 }\n";
}

struct Disorder {
  double amplitude;
  std::mt19937_64 random{11};
  double operator()() { return std::uniform_real_distribution<double>(-amplitude, amplitude)(random); }
};

// u_t = a lap u^2, a = k psi / (2 psi eta): u = t^-1/2 (C - r^2 / (16 a t^1/2)).
void spread_spot(int cells_to_rim, const std::vector<std::string>& set, double& error, double& front,
                 double& gas) {
  const decomp::Comm comm(MPI_COMM_SELF);
  constexpr double k = 1e-12, a = k / (2 * 2e-5), peak = 1e6;
  const double dx = 1.0 / cells_to_rim;
  // At t_0 the rim is at 1 and the pressure in the middle `peak`.
  const double c = peak, t0 = 1 / (16 * a * c);  // with t in units that make t_0^1/2 = 1: scaled below
  const auto exact = [&](double r, double t) {
    const double s = std::sqrt(t / t0);
    return std::fmax(c - r * r / (16 * a * t0 * s), 0.0) / s;
  };
  const int n = static_cast<int>(2.6 * 2 * cells_to_rim);
  Disorder shift{0.05};
  std::vector<Point> points;
  constexpr double floor = 1e-5;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = (i + 0.5 - 0.5 * n + shift()) * dx, y = (j + 0.5 - 0.5 * n + shift()) * dx;
      points.push_back({x, y, "foam", exact(std::hypot(x, y), t0) + floor * peak});
    }
  const std::string half = std::to_string(0.5 * n * dx);
  Simulation s = filled(comm,
                        {.domain = "lower = [-" + half + ", -" + half + "]\nupper = [" + half + ", " + half +
                                   "]\nperiodic = [true, true]",
                         .groups = foam + permeable(k),
                         .spacing = dx,
                         .set = set},
                        points);
  const Monitors monitors(s);
  const double first = monitors.values(s)[1];
  measure::run_until(s, 15 * t0);
  const double t = t0 + s.global().time;
  double sum = 0, all = 0, rim = 0;
  for (const measure::Sample& q : measure::samples(s)) {
    const double r = std::hypot(q.x[0], q.x[1]), u = exact(r, t);
    sum += std::abs(q.p - floor * peak - u);
    all += u;
    if (q.p > 1e-3 * exact(0, t)) rim = std::fmax(rim, r);
  }
  error = sum / all;
  front = (rim - std::sqrt(std::sqrt(t / t0))) / dx;
  gas = monitors.values(s)[1] / first - 1;
}

TEST(GasFlow, ASpotSpreadsAsBarenblattHasIt) {
  double error = 0, front = 0, gas = 0;
  spread_spot(8, {}, error, front, gas);
  EXPECT_LT(PINNED(error), 0.01);
  EXPECT_NEAR(PINNED(front), 0, 1.2);
  EXPECT_NEAR(gas, 0, 1e-12);
  spread_spot(16, {}, error, front, gas);
  EXPECT_LT(measure::pinned("error, 16", error), 0.005);
  EXPECT_NEAR(measure::pinned("front, 16", front), 0, 1);
}

// By the pressures of the end of the step, in steps that change no content by more than 5 % of the largest.
TEST(GasFlow, ASpotSpreadsImplicitly) {
  double error = 0, front = 0, gas = 0;
  spread_spot(16, {"terms.implicit_gas_flow=true"}, error, front, gas);
  EXPECT_LT(PINNED(error), 0.03);
  EXPECT_NEAR(PINNED(front), 0, 1);
  EXPECT_NEAR(gas, 0, 1e-12);
}

constexpr int across = 12, layers = 3;

// Between 3 and 1 bar: fluxes in and out, and the pressure in the middle, over the exact ones.
std::array<double, 3> darcy(const std::vector<std::string>& set) {
  const decomp::Comm comm(MPI_COMM_SELF);
  constexpr int n = 40;
  constexpr double dx = 1.0 / n, k = 2e-12;  // k psi = 1e-12
  Disorder shift{0.05};
  std::vector<Point> points;
  for (int a = -layers; a < n + layers; ++a)
    for (int b = 0; b < across; ++b) {
      const bool wall = a < 0 || a >= n;
      const double x = (a + 0.5 + (wall ? 0 : shift())) * dx, y = (b + 0.5 + (wall ? 0 : shift())) * dx;
      points.push_back({x, y,
                        a < 0    ? "high"
                        : a >= n ? "low"
                                 : "foam",
                        wall ? 1e5 : 1e5 * std::sqrt(9 - 8 * x)});
    }
  Simulation s = filled(comm,
                        {.domain = "lower = [-0.075, 0]\nupper = [1.075, " + std::to_string(across * dx) +
                                   "]\nperiodic = [false, true]",
                         .groups = foam + permeable(k) +
                                   "[[group]]\nname = \"high\"\nkind = \"wall\"\ngas_pressure = 3e5\n"
                                   "[[group]]\nname = \"low\"\nkind = \"wall\"\ngas_pressure = 1e5\n",
                         .spacing = dx,
                         .set = set},
                        points);
  const auto given = [&](bool left) {
    double sum = 0;
    const Particles& p = s.particles();
    for (std::size_t i = 0; i < p.owned(); ++i)
      if ((s.scale().metres(p.data<Field::position>()[2 * i]) < 0.5) == left)
        sum += p.data<Field::gas_inflow>()[i];
    return sum / (across * dx);
  };
  measure::run_until(s, 40);
  const double before = given(true), after = given(false), begin = s.global().time;
  measure::run_until(s, 50);
  const double time = s.global().time - begin;
  double middle = 0, count = 0;
  for (const measure::Sample& q : measure::samples(s))
    if (std::abs(q.x[0] - 0.5) < 2 * dx) middle += q.p, count += 1;
  return {(given(true) - before) / time / 4e-3, (after - given(false)) / time / 4e-3,
          middle / count / 2.23607e5};
}

TEST(GasFlow, FlowsAsDarcyHasIt) {
  const auto [in, out, middle] = darcy({});
  EXPECT_NEAR(PINNED(in), 1, 0.005);
  EXPECT_NEAR(PINNED(out), 1, 0.005);
  EXPECT_NEAR(PINNED(middle), 1, 0.005);
}

// Gas that loses pressure to its inertia besides (Forchheimer), k_2 = 1e-9 m: 3.4164e-3 kg/m2/s instead of 4e-3.
TEST(GasFlow, FlowsFastAsForchheimerHasIt) {
  const auto [in, out, middle] =
      darcy({"terms.implicit_gas_flow=true", "group.foam.permeability.inertial_coefficient=1e-9",
             "group.foam.permeability.inertial_exponent=0"});
  EXPECT_NEAR(PINNED(in * 4e-3 / 3.4164e-3), 1, 0.005);
  EXPECT_NEAR(PINNED(out * 4e-3 / 3.4164e-3), 1, 0.005);
}

TEST(GasFlow, FlowsImplicitlyAsDarcyHasIt) {
  const auto [in, out, middle] = darcy({"terms.implicit_gas_flow=true"});
  EXPECT_NEAR(PINNED(in), 1, 0.005);
  EXPECT_NEAR(PINNED(out), 1, 0.005);
  EXPECT_NEAR(PINNED(middle), 1, 0.005);
}

// A percent above the pressure of the surface: linear. What has left at 25, 50 and 90 %.
void let_out(double disorder, const std::vector<std::string>& set, std::vector<double>& lost) {
  const decomp::Comm comm(MPI_COMM_SELF);
  constexpr int n = 20;
  constexpr double dx = 1.0 / n, k = 2e-12, outside = 1e5, excess = 0.01;
  Disorder shift{disorder};
  std::vector<Point> points;
  for (int a = -layers; a < n; ++a)
    for (int b = 0; b < across; ++b) {
      const bool wall = a < 0;
      points.push_back({(b + 0.5 + (wall ? 0 : shift())) * dx, (a + 0.5 + (wall ? 0 : shift())) * dx,
                        wall ? "floor" : "foam", outside * (1 + excess)});
    }
  Simulation s = filled(comm,
                        {.domain = "lower = [0, -0.15]\nupper = [" + std::to_string(across * dx) +
                                   ", 1.5]\nperiodic = [true, false]",
                         .groups = foam + permeable(k) + "[[group]]\nname = \"floor\"\nkind = \"wall\"\n",
                         .spacing = dx,
                         .surface_pressure = outside,
                         .surface = true,
                         .set = set},
                        points);
  const Monitors monitors(s);
  const double diffusivity = k * psi * outside / (psi * 2e-5);
  const double all = outside * excess * psi / rt * (across * dx);  // of excess gas, per metre of depth
  for (const auto& [time, share] :
       {std::pair(0.049087, 0.25), std::pair(0.196731, 0.5), std::pair(0.848085, 0.9)}) {
    measure::run_until(s, time / diffusivity);
    lost.push_back(-monitors.values(s)[2] / all / share);
  }
}

TEST(GasFlow, EscapesThroughASurfaceAsTerzaghiHasIt) {
  std::vector<double> even, uneven, implicit;
  let_out(0.0, {}, even);
  let_out(0.1, {}, uneven);
  let_out(0.1, {"terms.implicit_gas_flow=true", "time.dt=0.15"}, implicit);  // twice the explicit limit
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(measure::pinned(("even " + std::to_string(k)).c_str(), even[k]), 1, 0.03);
    EXPECT_NEAR(measure::pinned(("uneven " + std::to_string(k)).c_str(), uneven[k]), 1, 0.03);
    EXPECT_NEAR(measure::pinned(("implicit " + std::to_string(k)).c_str(), implicit[k]), 1, 0.03);
  }
}

// Foam that moves as it loses its gas, until what is left is dissolved.
TEST(GasFlow, FoamThatMovesLosesAllThatIsNotDissolved) {
  const decomp::Comm comm(MPI_COMM_SELF);
  Simulation s(comm, read_scene(PEPERITE_ACCURACY_DIR "/degassing.toml", {}));
  const Monitors monitors(s);
  const std::vector<double> first = monitors.values(s);  // mass, gas, gas from outside
  measure::run_until(s, 18);
  const std::vector<double> last = monitors.values(s);
  const double load = (first[0] - first[1]) / 6.5 * 9.81, kept = (1e5 + load / 2) / 1e9;
  EXPECT_NEAR(PINNED((1 - last[1] / first[1]) / (1 - kept / 1e-3)), 1, 0.01);
  EXPECT_NEAR((last[1] - last[2]) / first[1], 1, 1e-12);
  // Some foam stays afloat, a few pascals short of the pressure that would drive its gas out.
  double afloat = 0, all = 0;
  const Particles& p = s.particles();
  for (std::size_t i = 0; i < p.owned(); ++i) {
    if (s.scene().groups[p.data<Field::group>()[i]].kind == GroupKind::wall) continue;
    afloat += p.data<Field::void_fraction>()[i] > 0.02 ? 1 : 0;
    all += 1;
  }
  EXPECT_LT(PINNED(afloat / all), 0.02);
}

}  // namespace
