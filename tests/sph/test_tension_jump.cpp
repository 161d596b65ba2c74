// Surface tension as a jump of the pressure: the curvature that it finds against that of the shape, the
// momentum that it leaves, and drops at rest in thin fluids, Oh = 0.002, R = rho = sigma = 1.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "sph/step/simulation.hpp"

namespace {

using sph::Field;

constexpr const char* fluids = R"(
[kernel]
h_over_dx = 1.2
[[group]]
name = "outer"
kind = "fluid"
density = 1
sound_speed = 10
viscosity = 0.002
[[group]]
name = "drop"
kind = "fluid"
density = 1
sound_speed = 10
viscosity = 0.002
[terms]
shifting = true
surface_tension = { between = ["drop", "outer"], coefficient = 1, form = "jump" }
[time]
cfl = 0.8
steps = 100000
)";

constexpr const char* box2 = R"(
dimension = 2
[domain]
lower = [-2, -2]
upper = [2, 2]
periodic = [true, true]
)";

constexpr const char* ball = R"(
jitter = 0.05
[[start.region]]
group = "outer"
[[start.region]]
group = "drop"
shape = "ball"
radius = 1
)";

std::string drop(int spacings, int dim) {
  return std::string(dim == 2 ? box2
                              : "dimension = 3\n[domain]\nlower = [-1.75, -1.75, -1.75]\n"
                                "upper = [1.75, 1.75, 1.75]\nperiodic = [true, true, true]\n") +
         fluids + "[start]\nspacing = " + std::to_string(1.0 / spacings) + ball +
         (dim == 2 ? "centre = [0, 0]\n" : "centre = [0, 0, 0]\n");
}

sph::Simulation start(const decomp::Comm& comm, const std::string& scene,
                      const std::vector<std::string>& overrides = {}) {
  return {comm, sph::parse_scene(scene, "drop", overrides)};
}

/// Of what is near the interface, the weighted mean of f(position, curvature) over the particles.
template <class Function>
double layer_mean(const sph::Simulation& s, Function f) {
  const sph::Particles& p = s.particles();
  const auto d = static_cast<std::size_t>(p.dim());
  double sum = 0, weights = 0;
  for (std::size_t i = 0; i < p.owned(); ++i) {
    std::array<double, 3> x{};
    double square = 0;
    for (std::size_t a = 0; a < d; ++a) {
      x[a] = s.scale().metres(p.data<Field::position>()[i * d + a]);
      square += p.data<Field::colour_gradient>()[i * d + a] * p.data<Field::colour_gradient>()[i * d + a];
    }
    sum += std::sqrt(square) * f(x, p.data<Field::curvature>()[i]);
    weights += std::sqrt(square);
  }
  return sum / weights;
}

double mean_curvature(const sph::Simulation& s) {
  return layer_mean(s, [](const std::array<double, 3>&, double curvature) { return curvature; });
}

TEST(TensionJump, CurvatureOfACircleAndOfASphere) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation circle = start(comm, drop(16, 2)), sphere = start(comm, drop(8, 3));
  circle.step();
  sphere.step();
  EXPECT_NEAR(mean_curvature(circle), 1, 0.02);
  EXPECT_NEAR(mean_curvature(sphere), 2, 0.06);
}

TEST(TensionJump, TheFirstFluidInsideIsPositive) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s =
      start(comm, drop(16, 2),
            {R"(terms.surface_tension={ between = ["outer", "drop"], coefficient = 1, form = "jump" })"});
  s.step();
  EXPECT_NEAR(mean_curvature(s), -1, 0.02);
}

// r = 1 + eps cos 2 phi: curvature 1 + 3 eps cos 2 phi to first order, and so is what its mode 2 is.
TEST(TensionJump, CurvatureOfAnOval) {
  constexpr double eps = 0.1;
  constexpr int n = 20;
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("peperite_oval_" + std::to_string(getpid()) + ".csv");
  {
    std::ofstream csv(file);
    csv << "id,x,y,vx,vy,group,rho,m\n";
    int id = 0;
    for (int a = 0; a < 4 * n; ++a)
      for (int b = 0; b < 4 * n; ++b) {
        const double x = (a + 0.5) / n - 2, y = (b + 0.5) / n - 2, r = std::hypot(x, y);
        const bool inside = r < 1 + eps * (x * x - y * y) / (r * r);
        csv << ++id << ',' << x << ',' << y << ",0,0," << inside << ",1,0\n";
      }
  }
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s =
      start(comm, std::string(box2) + fluids + "[start]\nspacing = 0.05\nfile = \"" + file.string() + "\"\n");
  s.step();
  std::filesystem::remove(file);
  const double mode = 2 * layer_mean(s, [](const std::array<double, 3>& x, double curvature) {
                        return curvature * (x[0] * x[0] - x[1] * x[1]) / (x[0] * x[0] + x[1] * x[1]);
                      });
  double exact = 0, length = 0;  // the same mean over the curve
  for (int k = 0; k < 3600; ++k) {
    const double phi = k * std::numbers::pi / 1800, c = std::cos(2 * phi);
    const double r = 1 + eps * c, slope = -2 * eps * std::sin(2 * phi), bend = -4 * eps * c;
    const double ds = std::sqrt(r * r + slope * slope);
    exact += 2 * c * (r * r + 2 * slope * slope - r * bend) / (ds * ds);
    length += ds;
  }
  EXPECT_NEAR(mode, exact / length, 0.15 * exact / length);
}

struct Rest {
  double jump = 0, speed = 0, momentum = 0;
};

/// Means over the second half of 6 units of time; momentum at their end.
Rest rest(const std::vector<std::string>& overrides) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s = start(comm, drop(8, 2), overrides);
  Rest out;
  int count = 0;
  const sph::Particles& p = s.particles();
  while (s.global().time < 6) {
    s.step();
    if (s.global().time < 3) continue;
    ++count;
    double inside = 0, outside = 0, square = 0;
    std::array<double, 2> momentum{};
    int within = 0, beyond = 0;
    for (std::size_t i = 0; i < p.owned(); ++i) {
      const double* v = p.data<Field::velocity>() + 2 * i;
      const double r = std::hypot(s.scale().metres(p.data<Field::position>()[2 * i]),
                                  s.scale().metres(p.data<Field::position>()[2 * i + 1]));
      const double pressure = p.data<Field::pressure>()[i], mass = p.data<Field::mass>()[i];
      square += mass * (v[0] * v[0] + v[1] * v[1]) / 16;
      for (std::size_t a = 0; a < 2; ++a) momentum[a] += mass * v[a];
      if (r < 0.6) inside += pressure, ++within;
      if (r > 1.5) outside += pressure, ++beyond;
    }
    out.jump += inside / within - outside / beyond;
    out.speed += std::sqrt(square);
    out.momentum = std::hypot(momentum[0], momentum[1]);
  }
  out.jump /= count;
  out.speed /= count;
  return out;
}

TEST(TensionJump, DropsRestInThinFluids) {
  const Rest volume = rest({});
  EXPECT_NEAR(volume.jump, 1, 0.05);
  EXPECT_LT(volume.speed, 0.06);
  EXPECT_LT(volume.momentum, 0.06);  // of the 2 pi 6 that tension has pushed in
  const Rest density = rest({"terms.pressure_weights=density"});
  EXPECT_NEAR(density.jump, 1, 0.05);
  EXPECT_LT(density.speed, 0.06);
  const Rest stress = rest({R"(terms.surface_tension={ between = ["drop", "outer"], coefficient = 1 })"});
  EXPECT_GT(stress.speed, 2 * volume.speed);
}

}  // namespace
