// What stops a run: each guard names particle, place, step and the key to change, the same on any ranks.
#include <fmt/format.h>

#include <cmath>

#include "sph/findings.hpp"
#include "sph/simulation.hpp"

namespace sph {

std::string Simulation::place_of(const Particles& particles, std::size_t row) const {
  const auto d = static_cast<std::size_t>(particles.dim());
  std::vector<double> at;
  for (std::size_t a = 0; a < d; ++a)
    at.push_back(scale_.metres(wrap()(static_cast<int>(a), particles.data<Field::position>()[row * d + a])));
  return place_text(at);
}

// What updates have found comes first: what is not finite may follow from it. Then in the order in which a
// step goes on: to lists, which follow the skin, what is not finite spreads with the forces.
void Simulation::stop_at_fault() const {
  findings_.stop(comm_);
  for (const Field f : {Field::density, Field::pressure, Field::sound_speed, Field::velocity}) {
    Findings found;
    for (const ParticleSet& set : sets_)
      if (set.particles.has(f)) found.add(find_infinite(set.particles, f));
    found.stop(comm_, step_text(global_.step));
  }
  stop_at_fastest("accelerations are not finite; reduce time.dt or time.cfl");
}

Findings Simulation::find_infinite(const Particles& particles, Field f) const {
  Findings found;
  const double* values = particles.table().as<double>(particles.column(f));
  const std::size_t components = f == Field::velocity ? static_cast<std::size_t>(particles.dim()) : 1;
  for (std::size_t i = 0; i < particles.owned(); ++i) {
    double size2 = 0;  // too large to be squared is too large
    for (std::size_t k = i * components; k < (i + 1) * components; ++k) size2 += values[k] * values[k];
    if (std::isfinite(size2)) continue;
    const std::uint64_t id = particles.data<Field::id>()[i];
    found.add(id, [&] {
      return fmt::format("particle {}: {} is not finite {}; reduce time.dt or time.cfl", id, info(f).name,
                         place_of(particles, i));
    });
  }
  return found;
}

// How far the halo and the lists must reach follows from how far particles move in a step: not without end.
void Simulation::guard_motion(double next) const {
  const double way = std::fmax(next, look_back());
  if (way > 0.5 * scene_.support())
    stop_at_fastest(
        fmt::format("it might move {:.6g} m in a step, more than half the kernel's radius; reduce "
                    "time.dt or time.cfl",
                    way));
  for (const Model* m : parts_.models)
    if (!(global_.max_speed <= m->speed_limit()))
      stop_at_fastest(fmt::format(
          "more than {:.6g} m/s, ten times the speed of sound (without liquids the speed of light); "
          "look at start.velocity, the sound speeds and time.dt",
          m->speed_limit()));
}

void Simulation::stop_at_fastest(const std::string& what) const {
  const auto speed_of = [&](const Particles& particles, std::size_t i) {
    const auto d = static_cast<std::size_t>(particles.dim());
    const double* v = particles.data<Field::velocity>();
    double v2 = 0;
    for (std::size_t a = 0; a < d; ++a) v2 += v[i * d + a] * v[i * d + a];
    return std::sqrt(v2);
  };
  std::array<double, 1> largest{0};
  for (const ParticleSet& set : sets_)
    for (std::size_t i = 0; i < set.particles.owned(); ++i)
      largest[0] = std::fmax(largest[0], speed_of(set.particles, i));
  comm_.max(largest);
  Findings found;
  for (const ParticleSet& set : sets_)
    for (std::size_t i = 0; i < set.particles.owned(); ++i) {
      if (!(speed_of(set.particles, i) >= largest[0])) continue;
      const std::uint64_t id = set.particles.data<Field::id>()[i];
      found.add(id, [&] {
        return fmt::format("the fastest particle, {} {}, has a speed of {:.6g} m/s: {}", id,
                           place_of(set.particles, i), largest[0], what);
      });
    }
  found.stop(comm_, step_text(global_.step));
  throw GuardError(step_text(global_.step) + what);
}

}  // namespace sph
