// The implicit viscous step against the equation that it solves, summed over all pairs by brute force, and
// the distance of walls on which it rests.
#include <gtest/gtest.h>

#include <cmath>

#include "sph/core/kernels.hpp"
#include "sph/models/wall_distance.hpp"
#include "sph/step/simulation.hpp"

namespace {

// Fluid 1000 times as viscous under a thinner one of half the density, on a floor that slides.
constexpr const char* layers = R"(
[domain]
lower = [0, -4]
upper = [12, 14]
periodic = [true, false]
gravity = [0.3, -1]
[kernel]
h_over_dx = 1
[[group]]
name = "thick"
kind = "fluid"
density = 1000
sound_speed = 20
viscosity = 1e5
[[group]]
name = "thin"
kind = "fluid"
density = 500
sound_speed = 20
viscosity = 100
[[group]]
name = "floor"
kind = "wall"
velocity = [2, 0]
[start]
spacing = 1
lower = [0, -3]
upper = [12, 8]
origin = [0, 0]
jitter = 0.1
velocity = [0.5, -0.2]
[[start.region]]
group = "floor"
[[start.region]]
group = "thick"
shape = "box"
lower = [0, 0]
upper = [12, 4]
[[start.region]]
group = "thin"
shape = "box"
lower = [0, 4]
upper = [12, 8]
[time]
dt = 0.03
steps = 1
)";

struct Particle {
  std::array<double, 2> x, v;
  double mass, volume, viscosity;
  bool wall;
};

std::vector<Particle> after_a_step(const std::vector<std::string>& overrides) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s(comm, sph::parse_scene(layers, "layers", overrides));
  s.step();
  const sph::Particles& p = s.particles();
  std::vector<Particle> out(p.owned());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::uint32_t group = p.data<sph::Field::group>()[i];
    for (std::size_t a = 0; a < 2; ++a) {
      out[i].x[a] = s.scale().metres(p.data<sph::Field::position>()[2 * i + a]);
      out[i].v[a] = p.data<sph::Field::velocity>()[2 * i + a];
    }
    out[i].mass = p.data<sph::Field::mass>()[i];
    out[i].volume = out[i].mass / p.data<sph::Field::density>()[i];
    out[i].viscosity = s.scene().groups[group].viscosity;
    out[i].wall = s.physics()->constants().is_wall(group);
  }
  return out;
}

/// x_j - x_i, its length, W and -W' / length; h = 1.
struct Pair {
  double e[2], r, w, f;
  Pair(const Particle& i, const Particle& j) {
    for (std::size_t a = 0; a < 2; ++a) e[a] = j.x[a] - i.x[a];
    e[0] -= 12 * std::nearbyint(e[0] / 12);
    r = std::hypot(e[0], e[1]);
    const double alpha = sph::Quintic::normalisation<2>;
    w = alpha * sph::Quintic::value<2>(r);
    f = r > 0 ? -alpha * sph::Quintic::slope<2>(r) / r : 0.0;
  }
};

/// -1/2 sum of W' r^(n - 1) over the lattice.
double moment(int n) {
  double sum = 0;
  for (int a = -4; a <= 4; ++a)
    for (int b = -4; b <= 4; ++b) {
      const double r = std::hypot(a, b);
      sum -= 0.5 * sph::Quintic::normalisation<2> * sph::Quintic::slope<2>(r) * std::pow(r, n - 1);
    }
  return sum;
}

/// Largest of m (v - v*) - dt F(v) over the largest of m (v - v*).
double residual(const std::vector<Particle>& now, const std::vector<Particle>& without, bool symmetric) {
  const sph::WallDistance distance(sph::KernelShape::quintic, 2, 1.0);
  double worst = 0, largest = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const Particle& a = now[i];
    if (a.wall) continue;
    double share = 0, normal[2] = {0, 0}, force[2] = {0, 0};
    for (const Particle& b : now)
      if (const Pair p(a, b); b.wall) {
        share += b.volume * p.w;
        for (int k = 0; k < 2; ++k) normal[k] -= b.volume * p.f * p.e[k];
      }
    const double length = std::hypot(normal[0], normal[1]), away = std::fmax(distance(share), 0.25);
    for (const Particle& b : now) {
      const Pair p(a, b);
      double eta = 4 * a.viscosity * b.viscosity / (a.viscosity + b.viscosity);
      if (b.wall && length > 0)
        eta = 2 * a.viscosity * std::fmax(-(normal[0] * p.e[0] + normal[1] * p.e[1]) / (length * away), 0.0);
      const double drag = a.volume * b.volume * eta * p.f, u[2] = {b.v[0] - a.v[0], b.v[1] - a.v[1]};
      const double along = u[0] * p.e[0] + u[1] * p.e[1];
      for (int k = 0; k < 2; ++k)
        force[k] += drag * (symmetric ? 4 / moment(4) * along * p.e[k] : u[k] / moment(2));
    }
    for (std::size_t k = 0; k < 2; ++k) {
      const double impulse = a.mass * (a.v[k] - without[i].v[k]);
      worst = std::fmax(worst, std::abs(impulse - 0.03 * force[k]));
      largest = std::fmax(largest, std::abs(impulse));
    }
  }
  EXPECT_GT(largest, 100);
  return worst / largest;
}

TEST(ImplicitViscosity, SolvesTheEquationOfTheStep) {
  const std::vector<Particle> without = after_a_step({"group.thick.viscosity=0", "group.thin.viscosity=0"});
  for (const std::string form : {"laplacian", "symmetric"}) {
    const std::vector<std::string> implicit{"terms.implicit_viscosity=true", "terms.viscosity=" + form,
                                            "terms.viscosity_tolerance=1e-10"};
    const bool symmetric = form == "symmetric";
    EXPECT_LE(residual(after_a_step(implicit), without, symmetric), 1e-8) << form;
    // And with the tolerance that is the default, 0.03 s being 250 times what an explicit step could be.
    EXPECT_LE(residual(after_a_step({implicit[0], implicit[1]}), without, symmetric), 2e-3) << form;
  }
}

TEST(ImplicitViscosity, LimitsNoTimeStep) {
  const decomp::Comm comm(MPI_COMM_SELF);
  const std::vector<std::string> cfl{"time.dt=", "time.cfl=0.8"};
  const sph::Simulation slow(comm, sph::parse_scene(layers, "layers", cfl));
  std::vector<std::string> implicit = cfl;
  implicit.emplace_back("terms.implicit_viscosity=true");
  const sph::Simulation fast(comm, sph::parse_scene(layers, "layers", implicit));
  EXPECT_NEAR(slow.global().dt, 0.125 / (3 * 100), 1e-12);  // nu = 100 m^2/s, symmetric form
  EXPECT_NEAR(fast.global().dt, 0.8 / (20 + std::hypot(2, 0)), 1e-3);
}

TEST(WallDistance, IsExactForRowsOfALattice) {
  for (const double spacing : {1.0, 1 / 1.2, 0.5})
    for (const int dim : {2, 3}) {
      const sph::WallDistance distance(sph::KernelShape::quintic, dim, spacing);
      for (double away = 0.25 * spacing; away < 2.1; away += 0.25 * spacing) {
        double share = 0;  // of rows of wall at depths (k + 1/2) spacing, each a lattice of its own
        for (int k = 0; k < 40; ++k)
          for (int i = -40; i <= 40; ++i)
            for (int j = dim == 3 ? -40 : 0; j <= (dim == 3 ? 40 : 0); ++j) {
              const double z = away + (k + 0.5) * spacing;
              const double r = std::sqrt(z * z + spacing * spacing * (i * i + j * j));
              share += dim == 2
                           ? spacing * spacing * sph::Quintic::normalisation<2> * sph::Quintic::value<2>(r)
                           : spacing * spacing * spacing * sph::Quintic::normalisation<3> *
                                 sph::Quintic::value<3>(r);
            }
        EXPECT_NEAR(distance(share), away, 0.01 * spacing) << dim << ' ' << spacing;
      }
    }
}

}  // namespace
