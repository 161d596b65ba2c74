// Total-Lagrangian solids in fluids, and clamps: a plate under water, a light cylinder that rises through melt, momentum.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "accuracy/light_cylinder.hpp"
#include "accuracy/pinned.hpp"

namespace {

using measure::Sample, measure::samples, measure::run_until, measure::text;

sph::Simulation accuracy_scene(const decomp::Comm& comm, const std::string& name,
                               const std::vector<std::string>& overrides) {
  return sph::Simulation(comm, sph::read_scene(std::string(PEPERITE_ACCURACY_DIR "/") + name, overrides));
}

/// Mean of what swings, from `from` on, with a weight that is 0 at both ends: ten swings are gone to 1e-3.
class SwingMean {
 public:
  SwingMean(double from, double until) : from_(from), until_(until) {}
  void see(double time, double value) {
    if (time < from_) return;
    const double weight = 1 - std::cos(2 * std::numbers::pi * (time - from_) / (until_ - from_));
    sum_ += weight * value;
    weights_ += weight;
  }
  [[nodiscard]] double value() const { return sum_ / weights_; }

 private:
  double from_, until_, sum_ = 0, weights_ = 0;
};

/// Index of the free particle of a solid that is nearest to a point at the start, by id.
std::uint64_t particle_at(const sph::Simulation& s, double x, double y) {
  const std::vector<Sample> all = samples(s);
  std::size_t best = 0;
  const auto far = [&](std::size_t k) {
    return s.scene().groups[all[k].group].kind == sph::GroupKind::solid
               ? std::hypot(all[k].x[0] - x, all[k].x[1] - y)
               : 1e30;
  };
  for (std::size_t k = 0; k < all.size(); ++k)
    if (far(k) < far(best)) best = k;
  return s.particles().data<sph::Field::id>()[best];
}

double place(const sph::Simulation& s, std::uint64_t id, int axis) {
  const std::uint64_t* ids = s.particles().data<sph::Field::id>();
  const auto row = static_cast<std::size_t>(std::find(ids, ids + s.particles().owned(), id) - ids);
  return samples(s)[row].x[static_cast<std::size_t>(axis)];
}

constexpr double nu = 0.25;

/// Of a bar 8 m long and 1 m thick, `n` across, over Timoshenko's deflection or the stretch of a bar; less 1.
double bar(int n, bool hangs) {
  constexpr double bulk = 1e9, rho = 1000, length = 8, young = 3 * bulk * (1 - 2 * nu),
                   g = young / 2 / (1 + nu);
  constexpr double plane = young / (1 - nu * nu);
  const double dx = 1.0 / n, x = length - dx / 2;
  const double first = 1.875 * 1.875 * std::sqrt(plane / 12 / (rho * length * length * length * length));
  const double period = hangs ? 4 * length / std::sqrt(plane / rho) : 2 * std::numbers::pi / first;
  const double exact = hangs ? rho * (length * x - x * x / 2) / plane
                             : rho * (x * x * (x * x - 4 * length * x + 6 * length * length)) / (2 * plane) +
                                   rho * (length * x - x * x / 2) / (5.0 / 6 * g);
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s =
      accuracy_scene(comm, "hanging_bar.toml",
                     {text("start.spacing", dx), text("start.lower", -3 * dx, -0.5),
                      text("start.region.2.lower", -3 * dx, -0.5), text("time.until", 3 * period),
                      hangs ? text("domain.gravity", 1, 0) : text("domain.gravity", 0, -1)});
  const std::uint64_t tip = particle_at(s, x, dx / 2);
  const int axis = hangs ? 0 : 1;
  const double start = place(s, tip, axis);
  SwingMean mean(0, 3 * period);
  run_until(s, 3 * period, [&] { mean.see(s.global().time, std::abs(place(s, tip, axis) - start)); });
  const double error = mean.value() / exact - 1;
  std::printf("bar, %d across, %s: %+.2f %%\n", n, hangs ? "stretched" : "bent", 100 * error);
  return error;
}

TEST(WetBodies, ClampsHoldTheFace) {
  EXPECT_NEAR(PINNED(bar(6, true)), 0, 0.008);
  EXPECT_NEAR(PINNED(bar(6, false)), 0, 0.015);
  EXPECT_NEAR(PINNED(bar(10, false)), 0, 0.005);
}

constexpr const char* layers = R"(
dimension = 2
kernel = { h_over_dx = 1 }
domain = { lower = [0, -5], upper = [16, 45], periodic = [true, false], gravity = [0, -1e-3] }
[[group]]
name = "stiff"
kind = "solid"
lagrangian = "total"
density = 1
bulk_modulus = 4
shear_modulus = 2
[[group]]
name = "soft"
kind = "solid"
lagrangian = "total"
part_of = "stiff"
density = 2
bulk_modulus = 1
shear_modulus = 0.5
[[group]]
name = "floor"
kind = "wall"
clamps = "soft"
[start]
spacing = 1
region = [{ group = "none" }, { group = "floor", shape = "box", lower = [0, -3], upper = [16, 0] },
          { group = "soft", shape = "box", lower = [0, 0], upper = [16, 16] },
          { group = "stiff", shape = "box", lower = [0, 16], upper = [16, 32] }]
[time]
cfl = 0.5
until = 600
)";

/// Of the row at y at rest, downwards, over g: the integral of the weight above over the modulus.
double sag(double y) {
  constexpr double soft = 1 + 4.0 / 3 * 0.5, stiff = 4 * soft, rho = 2, light = 1, half = 16, g = 1e-3;
  const double below = std::min(y, half), above = std::max(y - half, 0.0);
  return g * ((light * half * below + rho * (half * below - below * below / 2)) / soft +
              light * (half * above - above * above / 2) / stiff);
}

// Two materials in one body: either sags by its own modulus and is bonded to the other.
TEST(WetBodies, LayersAreOneBody) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s(comm, sph::parse_scene(layers, "layers.toml", {}));
  const std::array<double, 3> heights{7.5, 15.5, 31.5};
  std::array<std::uint64_t, 3> rows{};
  for (std::size_t k = 0; k < 3; ++k) rows[k] = particle_at(s, 8.5, heights[k]);
  std::vector<SwingMean> mean(3, SwingMean(0, 600));
  run_until(s, 600, [&] {
    for (std::size_t k = 0; k < 3; ++k) mean[k].see(s.global().time, heights[k] - place(s, rows[k], 1));
  });
  const auto ratio = [&](std::size_t k) { return mean[k].value() / sag(heights[k]); };
  const double low = ratio(0), joint = ratio(1), top = ratio(2);
  EXPECT_NEAR(PINNED(low), 1, 0.01);
  EXPECT_NEAR(PINNED(joint), 1, 0.01);
  EXPECT_NEAR(PINNED(top), 1, 0.01);
}

constexpr const char* ball_on_clamp = R"(
dimension = 2
kernel = { h_over_dx = 1 }
domain = { lower = [-5, -5], upper = [30, 30] }
[[group]]
name = "beam"
kind = "solid"
lagrangian = "total"
density = 1000
sound_speed = 100
poisson_ratio = 0.25
[[group]]
name = "slot"
kind = "wall"
clamps = "beam"
[[group]]
name = "ball"
kind = "solid"
lagrangian = "total"
density = 1000
sound_speed = 100
poisson_ratio = 0.25
[start]
spacing = 1
velocity = [0, -0.5]
region = [{ group = "none" }, { group = "slot", shape = "box", lower = [0, 0], upper = [6, 6] },
          { group = "beam", shape = "box", lower = [6, 0], upper = [20, 6] },
          { group = "ball", shape = "ball", centre = [4, 10], radius = 3.2 }]
[time]
cfl = 0.5
until = 12
)";

// What touches a clamp pushes the clamp, not what is bonded to it (which would gain 7 %).
TEST(WetBodies, ContactWithAClampDoesNoWork) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s(comm, sph::parse_scene(ball_on_clamp, "ball.toml", {}));
  const auto energy = [&] {
    double sum = 0;
    for (const Sample& q : samples(s))
      if (!measure::is_wall(s, q)) sum += 0.5 * q.mass * (q.v[0] * q.v[0] + q.v[1] * q.v[1]);
    const double* strain = s.particles().data<sph::Field::strain_energy>();
    for (std::size_t i = 0; i < s.particles().owned(); ++i) sum += strain[i];
    return sum;
  };
  const double before = energy();
  double up = -1;
  run_until(s, 12, [&] {
    for (const Sample& q : samples(s))
      if (q.group == 2) up = std::max(up, q.v[1]);
  });
  EXPECT_GT(up, 0.3);  // the ball has come back
  EXPECT_NEAR(PINNED(energy() / before), 1, 0.01);
}

TEST(WetBodies, WaterOnAPlate) {
  constexpr double bulk = 2e8, young = 3 * bulk * (1 - 2 * nu), g = young / 2 / (1 + nu), thick = 0.1;
  constexpr double plane = young / (1 - nu * nu), load = 9.81 * (1000 * 0.5 + 2000 * thick);
  constexpr double exact =
      load * 12 / (384 * plane * thick * thick * thick) + load / (8 * 5.0 / 6 * g * thick);
  constexpr int n = 6;
  constexpr double dx = thick / n, wall = 3 * dx;
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s = accuracy_scene(
      comm, "water_on_plate.toml",
      {text("start.spacing", dx), text("start.lower", -wall, -thick), text("start.upper", 1 + wall, 0.6),
       text("start.region.1.lower", -wall, 0), text("start.region.1.upper", 1 + wall, 0.6),
       text("start.region.4.lower", -wall, -thick), text("start.region.4.upper", 1 + wall, 0)});
  const std::uint64_t middle = particle_at(s, 0.5 - dx / 2, -0.05 + dx / 2);
  const double start = place(s, middle, 1);
  SwingMean mean(0.1, 0.4);
  run_until(s, 0.4, [&] { mean.see(s.global().time, start - place(s, middle, 1)); });
  const double error = mean.value() / exact - 1;
  std::printf("water on a plate, %d across: %+.2f %%\n", n, 100 * error);
  EXPECT_NEAR(PINNED(error), 0, 0.02);
}

sph::Simulation elastic_cylinder(const decomp::Comm& comm, double dx, std::vector<std::string> more = {}) {
  more.insert(more.end(), {"group.cylinder.bulk_modulus=1e10", "group.cylinder.poisson_ratio=0.25"});
  return measure::light_cylinder(comm, dx, more);
}

double rise(double dx) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s = elastic_cylinder(comm, dx);
  const double moved = measure::rise_in_a_second(s);
  std::printf("elastic cylinder, dx %.2f m: rise %.4f m at 1 s\n", dx, moved);
  return moved;
}

// 1.2168 m at 0.25 m, which takes five minutes.
TEST(WetBodies, ElasticCylinderConverges) {
  const double coarse = rise(1), fine = rise(0.5);
  EXPECT_NEAR(PINNED(coarse), 1.2168, 0.004);
  EXPECT_NEAR(PINNED(fine), 1.2168, 0.0025);
}

struct Energies {
  double kinetic = 0, all = 0;
};

/// Against the surface: of motion, place, compression of the melt, p = K (rho / rho_0 - 1), and strain of the cylinder.
Energies energies(const sph::Simulation& s) {
  Energies sum;
  const std::vector<Sample> all = samples(s);
  const double* strain = s.particles().data<sph::Field::strain_energy>();
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Sample& q = all[k];
    if (measure::is_wall(s, q)) continue;
    const sph::Group& g = s.scene().groups[q.group];
    const double kinetic = 0.5 * q.mass * (q.v[0] * q.v[0] + q.v[1] * q.v[1]), rest = g.density / q.rho;
    sum.kinetic += kinetic;
    sum.all += kinetic - q.mass * s.scene().domain.gravity[1] * q.x[1];
    sum.all += g.kind == sph::GroupKind::fluid
                   ? q.mass * g.eos.bulk_modulus / g.density * (rest - 1 - std::log(rest))
                   : strain[k];
  }
  return sum;
}

// Nothing takes energy: pressure on the cylinder does the work of compression. At 1 s, and the most on the way, of sound.
TEST(WetBodies, EnergyStays) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s = elastic_cylinder(
      comm, 1, {"group.melt.viscosity=0", "group.cylinder.viscosity=0", "terms.density_diffusion=0"});
  const Energies before = energies(s);
  double most = 0;
  run_until(s, 1, [&] { most = std::max(most, std::abs(energies(s).all - before.all)); });
  const Energies after = energies(s);
  const double gain = (after.all - before.all) / after.kinetic;
  std::printf("light cylinder without dissipation, dx 1 m: energy %+.2f %%, on the way %.2f %%\n", 100 * gain,
              100 * most / after.kinetic);
  EXPECT_NEAR(PINNED(gain), 0, 0.01);
  EXPECT_LT(most / after.kinetic, 0.025);
}

TEST(WetBodies, MomentumStays) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s(
      comm, sph::read_scene(
                PEPERITE_TEST_DIR "/scenes/wet2d.toml",
                {"domain.gravity=[0, 0]", "start.pressure=uniform", "start.uniform_pressure=2e5",
                 "start.surface_height=", "domain.lower=[0, 0]", "domain.upper=[76, 16]",
                 "domain.periodic=[true, true]", "start.region.1.group=melt", "start.region.3.group=beam"}));
  const auto momentum = [&] {
    std::array<double, 2> sum{};
    for (const Sample& q : samples(s))
      for (std::size_t a = 0; a < 2; ++a) sum[a] += q.mass * q.v[a];
    return sum;
  };
  const std::array<double, 2> before = momentum();
  double size = 0, parted = 0;
  for (const Sample& q : samples(s)) size += q.mass * std::hypot(q.v[0], q.v[1]);
  run_until(s, 3);
  for (const Sample& q : samples(s)) parted = std::max(parted, std::abs(q.v[1] + 1));
  EXPECT_GT(parted, 0.005);  // pressure that is too much for a disordered lattice shakes all of it
  for (std::size_t a = 0; a < 2; ++a) EXPECT_NEAR(momentum()[a], before[a], 1e-12 * size);
}

// What keeps particles of a fluid under tension apart is no force between pairs: bodies, which have none of it, keep theirs.
TEST(WetBodies, ShiftingPushesNone) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s(
      comm, sph::read_scene(PEPERITE_TEST_DIR "/scenes/drop2d.toml", {"start.region.3.centre=[4, 1]"}));
  const auto momentum = [&] {
    double sum = 0;
    for (const Sample& q : samples(s)) sum += q.mass * q.v[0];
    return sum;
  };
  const double before = momentum();
  for (int k = 0; k < 400; ++k) s.step();
  EXPECT_NEAR(momentum(), before, 1e-11 * before);
}

}  // namespace
