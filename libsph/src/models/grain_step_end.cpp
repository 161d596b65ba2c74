// What a scene of grains has to say at the end of a step: contacts that are too strong or too deep, grains
// that are too fast, the forces on walls.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "models/grain_texts.hpp"
#include "sph/core/fixed_point.hpp"
#include "sph/models/grain_limits.hpp"
#include "sph/models/grains.hpp"

namespace sph {
namespace {

std::string text_of(const Scene& scene, const PositionScale& scale, const ContactFault& fault) {
  return fmt::format("grain {} {} and {}", fault.id, text_of_place(scene, scale, fault.x.data()),
                     text_of_partner(scene, fault.partner));
}

void add_too_fast(const Scene& scene, const PositionScale& scale, const StepState& s, Findings& found) {
  const double* v = s.particles.data<Field::velocity>();
  const std::int64_t* x = s.particles.data<Field::position>();
  const double dt = s.global.dt, longest = longest_grain_move(scene);
  for (std::size_t i = 0; i < s.particles.owned(); ++i) {
    if (scene.groups[s.particles.data<Field::group>()[i]].grain.fixed) continue;
    const double speed =
        std::sqrt(v[i * 3] * v[i * 3] + v[i * 3 + 1] * v[i * 3 + 1] + v[i * 3 + 2] * v[i * 3 + 2]);
    if (!(speed * dt > longest)) continue;
    const std::uint64_t id = s.particles.data<Field::id>()[i];
    found.add(id, [&] {
      // Where it came from: so fast, it may have wrapped around.
      std::array<std::int64_t, 3> at;
      for (std::size_t a = 0; a < 3; ++a) {
        const std::int64_t way = round_to_quanta(v[i * 3 + a] * (dt / scale.quantum));
        at[a] = static_cast<std::int64_t>(static_cast<std::uint64_t>(x[i * 3 + a]) -
                                          static_cast<std::uint64_t>(way));
      }
      return fmt::format("grain {} {} has a speed of {:.6g} m/s: {}", id,
                         text_of_place(scene, scale, at.data()), speed, grain_move_text(scene, speed * dt));
    });
  }
}

}  // namespace

void Grains::reserve(Reduction& r) {
  in_.strong = r.add_maximum();
  in_.deep = r.add_maximum();
  in_.halves = r.add_sums(6 * walls_.count());
}

bool Grains::report(const StepState&, Reduction& r) {
  r[in_.strong] = now_.sweep.strong.any() ? 1 : 0;
  r[in_.deep] = now_.sweep.deep.any() ? 1 : 0;
  std::ranges::copy(now_.force, r[in_.halves].begin());
  return true;
}

void Grains::guard(const decomp::Comm& comm, const StepState& s, const Reduction& r) const {
  const bool strong = r[in_.strong] > 0, deep = !strong && r[in_.deep] > 0;
  // Where a rank has found a fault it says nothing of its speeds: the fault is told then, on any ranks.
  const bool fast =
      !(r[Reduction::bad] > 0) && r[Reduction::speed] * s.global.dt > longest_grain_move(*scene_);
  if (!strong && !deep && !fast) return;
  Findings found;
  if (const ContactFault& f = now_.sweep.strong; strong && f.any())
    found.add(f.id, [&] {
      return fmt::format(
          "{}: a contact force of {:.6g} N is beyond the range of the sums, {:.6g} N; reduce time.dt or "
          "raise "
          "the stiffness",
          text_of(*scene_, scale_, f), f.value * table_.force_quantum(), f.limit * table_.force_quantum());
    });
  if (const ContactFault& f = now_.sweep.deep; deep && f.any())
    found.add(f.id, [&] {
      return fmt::format(
          "{}: an overlap of {:.6g} m is deeper than contact.largest_overlap allows, {:.6g} m; raise the "
          "stiffness or reduce time.dt",
          text_of(*scene_, scale_, f), f.value, f.limit);
    });
  if (!strong && !deep) add_too_fast(*scene_, scale_, s, found);
  found.stop(comm, step_text(s.global.step));
}

void Grains::act(const Reduction& r, GlobalState& global) {
  // As of grains: first the kick, then the drift.
  walls_.push(global, walls_.forces(r[in_.halves], global));
  if (alone_) {
    walls_.move(global);
    pairs_.ways().moved(1.0001 * r[Reduction::speed] * global.dt);
  }
}

}  // namespace sph
