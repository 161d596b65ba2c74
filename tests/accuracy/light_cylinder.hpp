// A light cylinder that rises through melt (apps/buoyant_cylinder/fluid_fine.toml), whatever it is made of; settings as texts.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "accuracy/measure.hpp"
#include "sph/models/energies.hpp"

namespace measure {

inline std::string text(const char* key, double value) {
  char out[64];
  std::snprintf(out, sizeof out, "%s=%.17g", key, value);
  return out;
}
inline std::string text(const char* key, double x, double y) {
  char out[96];
  std::snprintf(out, sizeof out, "%s=[%.17g, %.17g]", key, x, y);
  return out;
}

inline sph::Simulation light_cylinder(const decomp::Comm& comm, double dx,
                                      std::vector<std::string> settings) {
  const double wall = 3 * dx;
  for (const std::string& set :
       {text("start.spacing", dx), text("start.lower", 1.5 - wall, 1.5 - wall),
        text("start.upper", 46.5 + wall, 64), std::string("group.cylinder.kind=solid"),
        std::string("group.cylinder.lagrangian=total")})
    settings.push_back(set);
  return {comm, sph::read_scene(PEPERITE_TEST_DIR "/../apps/buoyant_cylinder/fluid_fine.toml", settings)};
}

/// How far it is at 1 s above where it was [m].
inline double rise_in_a_second(sph::Simulation& s) {
  const double start = mean_position(s, "cylinder", 1);
  run_until(s, 1);
  double v = 0;
  int n = 0;
  for (const Sample& q : samples(s))
    if (s.scene().groups[q.group].name == "cylinder") v += q.v[1], ++n;
  return mean_position(s, "cylinder", 1) - start - v / n * (s.global().time - 1);
}

/// As the models of a scene count it.
inline double energy_of(const sph::Simulation& s) {
  sph::EnergySums sums;
  for (const sph::Model* m : s.models()) m->add_energies(s.particles(m->set()), sums);
  return sums[sph::Energy::kinetic].value() + sums[sph::Energy::potential].value() +
         sums[sph::Energy::elastic].value();
}

}  // namespace measure
