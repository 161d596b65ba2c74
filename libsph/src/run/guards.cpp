// What stops a run: each guard names particle, place, step and the key to change, the same on any ranks.
#include <fmt/format.h>

#include <cmath>

#include "sph/findings.hpp"
#include "sph/fixed_point.hpp"
#include "sph/simulation.hpp"

namespace sph {

std::vector<double> Simulation::metres_of(std::size_t row) const {
  const auto d = static_cast<std::size_t>(particles_.dim());
  std::vector<double> at;
  for (std::size_t a = 0; a < d; ++a)
    at.push_back(scale_.metres(particles_.data<Field::position>()[row * d + a]));
  return at;
}

// all[0]: largest speed. all[4], all[5]: a contact on any rank is too strong, too deep.
void Simulation::guard_sweep(const std::array<double, 9>& all) const {
  const auto contact = [&](const ContactFault& fault) {
    const std::array<double, 3> at{scale_.metres(fault.x[0]), scale_.metres(fault.x[1]),
                                   scale_.metres(fault.x[2])};
    const std::string partner = (fault.partner & wall_key) != 0
                                    ? fmt::format("wall \"{}\"", scene_.walls[fault.partner & ~wall_key].name)
                                    : fmt::format("grain {}", fault.partner);
    return fmt::format("grain {} {} and {}", fault.id, place_text(at), partner);
  };
  Findings found;
  if (const ContactFault& f = grains_->swept().strong; all[4] > 0 && f.any())
    found.add(f.id, [&] {
      const double newton = grains_->force_quantum();
      return fmt::format(
          "{}: a contact force of {:.6g} N is beyond the range of the sums, {:.6g} N; reduce time.dt or "
          "raise "
          "the stiffness",
          contact(f), f.value * newton, f.limit * newton);
    });
  if (const ContactFault& f = grains_->swept().deep; !(all[4] > 0) && all[5] > 0 && f.any())
    found.add(f.id, [&] {
      return fmt::format(
          "{}: an overlap of {:.6g} m is deeper than contact.largest_overlap allows, {:.6g} m; raise the "
          "stiffness or reduce time.dt",
          contact(f), f.value, f.limit);
    });
  const double dt = global_.dt, limit = grains_->longest_move();
  if (!(all[4] > 0 || all[5] > 0) && !(all[0] * dt > limit)) return;
  const double* v = particles_.data<Field::velocity>();
  for (std::size_t i = 0; i < particles_.owned() && !(all[4] > 0 || all[5] > 0); ++i) {
    if (is_wall_group_[particles_.data<Field::group>()[i]]) continue;
    const double speed =
        std::sqrt(v[i * 3] * v[i * 3] + v[i * 3 + 1] * v[i * 3 + 1] + v[i * 3 + 2] * v[i * 3 + 2]);
    if (!(speed * dt > limit)) continue;
    const std::uint64_t id = particles_.data<Field::id>()[i];
    found.add(id, [&] {
      // Where it came from: so fast, it may have wrapped around.
      std::array<double, 3> at;
      for (std::size_t a = 0; a < 3; ++a) {
        const std::int64_t way = round_to_quanta(v[i * 3 + a] * (dt / scale_.quantum));
        at[a] = scale_.metres(static_cast<std::int64_t>(
            static_cast<std::uint64_t>(particles_.data<Field::position>()[i * 3 + a]) -
            static_cast<std::uint64_t>(way)));
      }
      return fmt::format("grain {} {} has a speed of {:.6g} m/s: {}", id, place_text(at), speed,
                         grains_->move_text(speed * dt));
    });
  }
  found.stop(comm_, step_text(global_.step));
}

std::vector<std::int64_t> Simulation::wall_forces(std::span<const std::int64_t> halves) const {
  const std::size_t n = halves.size() / 2;
  std::vector<std::int64_t> forces(n);
  for (std::size_t k = 0; k < n; ++k) {
    const std::int64_t high = halves[n + k] + (halves[k] >> 32);
    if (high >= std::int64_t{1} << 30 || high < -(std::int64_t{1} << 30))
      throw GuardError(fmt::format(
          "{}the force on wall \"{}\", {:.6g} N along {}, is beyond the range of the sums, {:.6g} N; reduce "
          "time.dt, or what presses on it",
          step_text(global_.step), scene_.walls[k / 3].name,
          std::ldexp(static_cast<double>(high), 32) * grains_->force_quantum(), "xyz"[k % 3],
          0x1p62 * grains_ -> force_quantum()));
    forces[k] = high * (std::int64_t{1} << 32) + (halves[k] & 0xffffffff);
  }
  return forces;
}

// What the physics found comes first: what is not finite may follow from it. Then in the order in which a
// step goes on: to lists, which follow the skin, what is not finite spreads with the forces.
void Simulation::stop_at_bad_particle() const {
  physics_.findings().stop(comm_);
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
  const double way = std::fmax(next, grains_ ? 0.0 : physics_.longest_look_back(global_));
  if (way > 0.5 * scene_.support())
    stop_at_fastest(
        fmt::format("it might move {:.6g} m in a step, more than half the kernel's radius; reduce "
                    "time.dt or time.cfl",
                    way));
  if (!grains_ && !(global_.max_speed <= physics_.speed_limit()))
    stop_at_fastest(fmt::format(
        "more than {:.6g} m/s, ten times the speed of sound (without liquids the speed of light); "
        "look at start.velocity, the sound speeds and time.dt",
        physics_.speed_limit()));
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
