// What a scene of grains has to say at the end of a step: contacts that are too strong or too deep, grains
// that are too fast, the forces on walls.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sph/core/fixed_point.hpp"
#include "sph/models/grains.hpp"

namespace sph {

void Grains::reserve(Reduction& r) {
  strong_ = r.add_maximum();
  deep_ = r.add_maximum();
  halves_ = r.add_sums(6 * scene_->walls.size());
}

bool Grains::report(const StepState&, Reduction& r) {
  r[strong_] = sweep_.strong.any() ? 1 : 0;
  r[deep_] = sweep_.deep.any() ? 1 : 0;
  std::ranges::copy(wall_force_, r[halves_].begin());
  return true;
}

// Inside the domain: rows are wrapped when lists are made anew, and a message must not tell when that was.
std::string Grains::text_of_place(const std::int64_t* quanta) const {
  std::array<double, 3> at;
  for (std::size_t a = 0; a < 3; ++a) at[a] = scale_.metres(wrap_(static_cast<int>(a), quanta[a]));
  return place_text(at);
}

std::string Grains::text_of(const ContactFault& fault) const {
  const std::string partner = (fault.partner & wall_key) != 0
                                  ? fmt::format("wall \"{}\"", scene_->walls[fault.partner & ~wall_key].name)
                                  : fmt::format("grain {}", fault.partner);
  return fmt::format("grain {} {} and {}", fault.id, text_of_place(fault.x.data()), partner);
}

void Grains::guard(const decomp::Comm& comm, const StepState& s, const Reduction& r) const {
  const bool strong = r[strong_] > 0, deep = !strong && r[deep_] > 0;
  // Where a rank has found a fault it says nothing of its speeds: the fault is told then, on any ranks.
  const bool fast = !(r[Reduction::bad] > 0) && r[Reduction::speed] * s.global.dt > longest_move_;
  if (!strong && !deep && !fast) return;
  Findings found;
  if (const ContactFault& f = sweep_.strong; strong && f.any())
    found.add(f.id, [&] {
      return fmt::format(
          "{}: a contact force of {:.6g} N is beyond the range of the sums, {:.6g} N; reduce time.dt or "
          "raise "
          "the stiffness",
          text_of(f), f.value * force_quantum_, f.limit * force_quantum_);
    });
  if (const ContactFault& f = sweep_.deep; deep && f.any())
    found.add(f.id, [&] {
      return fmt::format(
          "{}: an overlap of {:.6g} m is deeper than contact.largest_overlap allows, {:.6g} m; raise the "
          "stiffness or reduce time.dt",
          text_of(f), f.value, f.limit);
    });
  if (!strong && !deep) find_too_fast(s, found);
  found.stop(comm, step_text(s.global.step));
}

void Grains::find_too_fast(const StepState& s, Findings& found) const {
  const double* v = s.particles.data<Field::velocity>();
  const std::int64_t* x = s.particles.data<Field::position>();
  const double dt = s.global.dt;
  for (std::size_t i = 0; i < s.particles.owned(); ++i) {
    if (fixed_[s.particles.data<Field::group>()[i]]) continue;
    const double speed =
        std::sqrt(v[i * 3] * v[i * 3] + v[i * 3 + 1] * v[i * 3 + 1] + v[i * 3 + 2] * v[i * 3 + 2]);
    if (!(speed * dt > longest_move_)) continue;
    const std::uint64_t id = s.particles.data<Field::id>()[i];
    found.add(id, [&] {
      // Where it came from: so fast, it may have wrapped around.
      std::array<std::int64_t, 3> at;
      for (std::size_t a = 0; a < 3; ++a) {
        const std::int64_t way = round_to_quanta(v[i * 3 + a] * (dt / scale_.quantum));
        at[a] = static_cast<std::int64_t>(static_cast<std::uint64_t>(x[i * 3 + a]) -
                                          static_cast<std::uint64_t>(way));
      }
      return fmt::format("grain {} {} has a speed of {:.6g} m/s: {}", id, text_of_place(at.data()), speed,
                         grain_move_text(*scene_, speed * dt));
    });
  }
}

std::vector<std::int64_t> Grains::wall_forces(std::span<const std::int64_t> halves,
                                              const GlobalState& global) const {
  const std::size_t n = halves.size() / 2;
  std::vector<std::int64_t> forces(n);
  for (std::size_t k = 0; k < n; ++k) {
    const std::int64_t high = halves[n + k] + (halves[k] >> 32);
    if (high >= std::int64_t{1} << 30 || high < -(std::int64_t{1} << 30))
      throw GuardError(fmt::format(
          "{}the force on wall \"{}\", {:.6g} N along {}, is beyond the range of the sums, {:.6g} N; reduce "
          "time.dt, or what presses on it",
          step_text(global.step), scene_->walls[k / 3].name,
          std::ldexp(static_cast<double>(high), 32) * force_quantum_, "xyz"[k % 3], 0x1p62 * force_quantum_));
    forces[k] = high * (std::int64_t{1} << 32) + (halves[k] & 0xffffffff);
  }
  return forces;
}

void Grains::act(const Reduction& r, GlobalState& global) {
  const std::vector<std::int64_t> forces = wall_forces(r[halves_], global);
  if (alone_) move_walls(global);
  push_walls(global, forces);
}

}  // namespace sph
