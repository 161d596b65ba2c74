// A strip of fluids that conduct and do not move, between two walls or periodic: what tests of heat begin with.
#pragma once

#include <unistd.h>

#include <fstream>
#include <functional>
#include <random>
#include <string>

#include "accuracy/measure.hpp"

namespace measure {

using namespace sph;

/// A strip along x that is periodic across it, of square lattice with 5 % of disorder between even walls.
struct Strip {
  int cells;             ///< along x
  double length = 1;     ///< [m]
  double jitter = 0.05;  ///< [spacings]
  bool walls = true;     ///< at both ends; else periodic
  std::string materials;
  std::function<const char*(double)> group;  ///< at x between the walls
  std::function<double(double)> temperature;
  std::string more{};
  std::vector<std::string> set{};  ///< overrides
};

inline constexpr int across = 12, layers = 3;

inline Removed write_start(const Strip& s) {
  Removed made{std::filesystem::temp_directory_path() /
               ("peperite_heat_" + std::to_string(::getpid()) + ".csv")};
  std::ofstream out(made.file);
  out << "id,x,y,vx,vy,group,T\n";
  out.precision(17);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> shift(-s.jitter, s.jitter);
  const double dx = s.length / s.cells;
  int id = 0;
  for (int a = s.walls ? -layers : 0; a < s.cells + (s.walls ? layers : 0); ++a)
    for (int b = 0; b < across; ++b) {
      const bool wall = a < 0 || a >= s.cells;
      const double x = (a + 0.5 + (wall ? 0 : shift(random))) * dx;
      const double y = (b + 0.5 + (wall ? 0 : shift(random))) * dx;
      const char* group = a < 0 ? "left" : a >= s.cells ? "right" : s.group(x);
      out << id++ << ',' << x << ',' << y << ",0,0," << group << ',' << (wall ? 0 : s.temperature(x)) << '\n';
    }
  return made;
}

inline Simulation strip(const decomp::Comm& comm, const Strip& s) {
  const double dx = s.length / s.cells, end = s.walls ? layers * dx : 0;
  const auto made = write_start(s);
  std::string text = "kernel = { h_over_dx = 1.0 }\n[domain]\nlower = [" + std::to_string(-end) +
                     ", 0]\nupper = [" + std::to_string(s.length + end) + ", " + std::to_string(across * dx) +
                     "]\nperiodic = [" + (s.walls ? "false" : "true") + ", true]\n[terms]\nmotion = false\n" +
                     s.materials + "[start]\nspacing = " + std::to_string(dx) + "\nfile = \"" +
                     made.file.string() + "\"\nfree_surface = false\n[time]\nsteps = 1\n" +
                     "[[monitor]]\nkind = \"budget\"\n" + s.more;
  return {comm, parse_scene(text, "strip", s.set)};
}

inline std::string fluid(const std::string& name, const std::string& heat, double density = 1) {
  return "[[group]]\nname = \"" + name + "\"\nkind = \"fluid\"\ndensity = " + std::to_string(density) +
         "\nsound_speed = 1\ntemperature = 1\nheat = " + heat + "\n";
}

inline std::string wall(const std::string& name, const std::string& what) {
  return "[[group]]\nname = \"" + name + "\"\nkind = \"wall\"\n" + what + "\n";
}

/// Of every particle that is no wall: x, T, H, mass, group.
template <class Visit>
void for_each(const Simulation& s, Visit visit) {
  const Particles& p = s.particles();
  for (std::size_t i = 0; i < p.owned(); ++i) {
    const unsigned g = p.data<Field::group>()[i];
    if (s.scene().groups[g].kind == GroupKind::wall) continue;
    visit(s.scale().metres(p.data<Field::position>()[2 * i]), p.data<Field::temperature>()[i],
          p.data<Field::enthalpy>()[i], p.data<Field::mass>()[i], g);
  }
}

}  // namespace measure
