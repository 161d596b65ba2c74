// What stops a run: each guard names particle, place, step and the key to change, the same on any ranks.
#include <fmt/format.h>

#include <cmath>

#include "sph/findings.hpp"
#include "sph/simulation.hpp"

namespace sph {

std::vector<double> Simulation::metres_of(std::size_t row) const {
  const auto d = static_cast<std::size_t>(particles_.dim());
  std::vector<double> at;
  for (std::size_t a = 0; a < d; ++a)
    at.push_back(scale_.metres(wrap()(static_cast<int>(a), particles_.data<Field::position>()[row * d + a])));
  return at;
}

// What updates have found comes first: what is not finite may follow from it. Then in the order in which a
// step goes on: to lists, which follow the skin, what is not finite spreads with the forces.
void Simulation::stop_at_fault() const {
  findings_.stop(comm_);
  const auto d = static_cast<std::size_t>(particles_.dim());
  Findings found;
  for (const Field f : {Field::density, Field::pressure, Field::sound_speed, Field::velocity}) {
    if (!particles_.has(f)) continue;
    const double* values = particles_.table().as<double>(particles_.column(f));
    const std::size_t components = f == Field::velocity ? d : 1;
    for (std::size_t i = 0; i < particles_.owned(); ++i) {
      double size2 = 0;  // too large to be squared is too large
      for (std::size_t k = i * components; k < (i + 1) * components; ++k) size2 += values[k] * values[k];
      if (std::isfinite(size2)) continue;
      const std::uint64_t id = particles_.data<Field::id>()[i];
      found.add(id, [&] {
        return fmt::format("particle {}: {} is not finite {}; reduce time.dt or time.cfl", id, info(f).name,
                           place_text(metres_of(i)));
      });
    }
    found.stop(comm_, step_text(global_.step));
  }
  stop_at_fastest("accelerations are not finite; reduce time.dt or time.cfl");
}

// How far the halo and the lists must reach follows from how far particles move in a step: not without end.
void Simulation::guard_motion(double next) const {
  const double way = std::fmax(next, look_back());
  if (way > 0.5 * scene_.support())
    stop_at_fastest(
        fmt::format("it might move {:.6g} m in a step, more than half the kernel's radius; reduce "
                    "time.dt or time.cfl",
                    way));
  for (const Model* m : models_)
    if (!(global_.max_speed <= m->speed_limit()))
      stop_at_fastest(fmt::format(
          "more than {:.6g} m/s, ten times the speed of sound (without liquids the speed of light); "
          "look at start.velocity, the sound speeds and time.dt",
          m->speed_limit()));
}

void Simulation::stop_at_fastest(const std::string& what) const {
  const auto d = static_cast<std::size_t>(particles_.dim());
  const double* v = particles_.data<Field::velocity>();
  const auto speed_of = [&](std::size_t i) {
    double v2 = 0;
    for (std::size_t a = 0; a < d; ++a) v2 += v[i * d + a] * v[i * d + a];
    return std::sqrt(v2);
  };
  std::array<double, 1> largest{0};
  for (std::size_t i = 0; i < particles_.owned(); ++i) largest[0] = std::fmax(largest[0], speed_of(i));
  comm_.max(largest);
  Findings found;
  for (std::size_t i = 0; i < particles_.owned(); ++i) {
    if (!(speed_of(i) >= largest[0])) continue;
    const std::uint64_t id = particles_.data<Field::id>()[i];
    found.add(id, [&] {
      return fmt::format("the fastest particle, {} {}, has a speed of {:.6g} m/s: {}", id,
                         place_text(metres_of(i)), largest[0], what);
    });
  }
  found.stop(comm_, step_text(global_.step));
  throw GuardError(step_text(global_.step) + what);
}

}  // namespace sph
