#include "step/guards.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace sph {
namespace {

std::string place_of(const State& s, const Particles& particles, std::size_t row) {
  const auto d = static_cast<std::size_t>(particles.dim());
  std::vector<double> at;
  for (std::size_t a = 0; a < d; ++a)
    at.push_back(
        s.scale().metres(s.wrap()(static_cast<int>(a), particles.data<Field::position>()[row * d + a])));
  return place_text(at);
}

Findings find_infinite(const State& s, const Particles& particles, Field f) {
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
                         place_of(s, particles, i));
    });
  }
  return found;
}

[[noreturn]] void stop_at_fastest(const State& s, const std::string& what) {
  const auto speed_of = [&](const Particles& particles, std::size_t i) {
    const auto d = static_cast<std::size_t>(particles.dim());
    const double* v = particles.data<Field::velocity>();
    double v2 = 0;
    for (std::size_t a = 0; a < d; ++a) v2 += v[i * d + a] * v[i * d + a];
    return std::sqrt(v2);
  };
  std::array<double, 1> largest{0};
  for (const ParticleSet& set : s.sets())
    for (std::size_t i = 0; i < set.particles.owned(); ++i)
      largest[0] = std::fmax(largest[0], speed_of(set.particles, i));
  s.comm().max(largest);
  Findings found;
  for (const ParticleSet& set : s.sets())
    for (std::size_t i = 0; i < set.particles.owned(); ++i) {
      if (!(speed_of(set.particles, i) >= largest[0])) continue;
      const std::uint64_t id = set.particles.data<Field::id>()[i];
      found.add(id, [&] {
        const std::string speed =
            std::isfinite(largest[0]) ? fmt::format("a speed of {:.6g} m/s", largest[0]) : "no finite speed";
        return fmt::format("the fastest particle, {} {}, has {}: {}", id, place_of(s, set.particles, i),
                           speed, what);
      });
    }
  found.stop(s.comm(), step_text(s.global().step));
  throw GuardError(step_text(s.global().step) + what);
}

}  // namespace

// What updates have found comes first: what is not finite may follow from it. Then in the order in which a
// step goes on: to lists, which follow the skin, what is not finite spreads with the forces.
void stop_at_fault(const State& s, const Findings& findings) {
  findings.stop(s.comm());
  for (const Field f : {Field::density, Field::pressure, Field::sound_speed, Field::velocity}) {
    Findings found;
    for (const ParticleSet& set : s.sets())
      if (set.particles.has(f)) found.add(find_infinite(s, set.particles, f));
    found.stop(s.comm(), step_text(s.global().step));
  }
  stop_at_fastest(s, "accelerations are not finite; reduce time.dt or time.cfl");
}

// How far the halo and the lists must reach follows from how far particles move in a step: not without end.
void guard_motion(const State& s, double way) {
  if (way > 0.5 * s.scene().support())
    stop_at_fastest(
        s, fmt::format("it might move {} in a step, more than half the kernel's radius; reduce time.dt or "
                       "time.cfl",
                       std::isfinite(way) ? fmt::format("{:.6g} m", way) : "any distance"));
  for (const Model* m : s.models())
    if (!(s.global().max_speed <= m->speed_limit()))
      stop_at_fastest(
          s, fmt::format(
                 "more than {:.6g} m/s, ten times the speed of sound (without liquids the speed of light); "
                 "look at start.velocity, the sound speeds and time.dt",
                 m->speed_limit()));
}

}  // namespace sph
