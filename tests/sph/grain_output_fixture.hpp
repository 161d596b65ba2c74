// Small scenes of grains whose contacts are known, and a look at what they write.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "files/hdf5_file.hpp"
#include "output/extra_columns.hpp"  // private: what snapshots are made of
#include "sph/output/monitors.hpp"
#include "state_fixture.hpp"

namespace sph::test {

inline const std::string domain = R"(
title = "grains"
[domain]
lower = [0, 0, 0]
upper = [0.2, 0.2, 0.2]
periodic = [true, false, false]
gravity = [0, 0, -9.81]
[[wall]]
name = "floor"
material = "sand"
point = [0, 0, 0]
normal = [0, 0, 1]
velocity = [0.25, 0, 0]
[output]
contacts = true
[[monitor]]
kind = "energy"
[[monitor]]
kind = "contacts"
[[monitor]]
kind = "wall"
wall = "floor"
[time]
until = 1
[[group]]
name = "sand"
kind = "grain"
density = 2000
)";
inline const std::string springs = R"(diameter = [0.019, 0.02]
normal_stiffness = 1000
tangential_stiffness = 250
restitution = 0.1
friction = 0.5
[contact]
law = "linear"
)";
inline const std::string hertz = R"(diameter = [0.019, 0.02]
young_modulus = 2e6
poisson_ratio = 0.25
restitution = 0.1
friction = 0.5
rolling_friction = 0.1
[contact]
law = "hertz"
)";
inline const std::string glued = R"(
[[group]]
name = "glued"
kind = "grain"
density = 2000
diameter = 0.02
normal_stiffness = 1000
restitution = 0.1
friction = 0.5
fixed = true
)";
// Grain 3 is 1 mm in the floor, grain 7 1.5 mm in grain 3, across no face; both 1 cm in radius.
inline const std::string header = "id,x,y,z,vx,vy,vz,group,radius,wx,wy,wz\n";
inline const std::string stack =
    header + "7,0.11,0.1,0.0275,0,0,0,sand,0.01,0,0,0\n" + "3,0.11,0.1,0.009,2,0,0,sand,0.01,0,5,0\n";

inline const double volume = 4.0 / 3.0 * std::numbers::pi * 1e-6, mass = 2000 * volume;

class GrainOutput : public ::testing::Test {
 protected:
  /// A scene whose grains are `rows`.
  [[nodiscard]] Scene scene_of(const std::string& text, const std::string& rows) {
    if (world_.rank() == 0) std::ofstream(scratch_.path() / "grains.csv") << rows;
    world_.barrier();
    return parse_scene(domain + text + "[start]\nfile = \"grains.csv\"\n",
                       (scratch_.path() / "scene.toml").string(), {});
  }
  decomp::Comm world_{MPI_COMM_WORLD};
  ScratchDirectory scratch_{world_};
};

inline double value(Simulation& s, const std::string& name) {
  const Monitors monitors(s);
  const std::vector<double> values = monitors.values(s);
  for (std::size_t k = 0; k < values.size(); ++k)
    if (monitors.names()[k] == name) return values[k];
  ADD_FAILURE() << "no column " << name;
  return 0;
}

inline void expect_share(double value, double expected) {
  EXPECT_NEAR(value / expected, 1, 1e-6) << expected;
}

inline void write(Simulation& s, const std::filesystem::path& path) {
  write_snapshot(s.comm(), path, s.particles(), s.global(), s.scale(), s.wrap(), {"", s.fingerprint(), {}},
                 extra_columns(s), 1000000, contact_columns(s));
}

template <class T>
std::vector<T> read(const std::filesystem::path& path, const std::string& name, Element element) {
  const Hdf5Reader file(path);
  std::vector<T> values(file.rows(name) * static_cast<std::size_t>(file.components(name)));
  if (!values.empty()) file.read(name, element, values.data());
  return values;
}

}  // namespace sph::test
