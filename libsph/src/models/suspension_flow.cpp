// What grains make of the flow around them, and how long it may serve.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "models/screening.hpp"
#include "sph/core/findings.hpp"
#include "sph/laws/drag/law.hpp"
#include "sph/models/suspension.hpp"

namespace sph {
namespace {

/// m0: of a force that is spread over the grid with quadratic B-splines and seen through them, whatever its place in
/// a cell, within 6 %: U = m0 F / (eta h).
constexpr double self_mobility = 0.0656;
constexpr double most_own = 0.8;      // of zeta times a: beyond that the grain is too large for h
constexpr double way_of_step = 0.25;  // of a grain in a step, in radii of the smallest
constexpr double most_steps = 1e7;

}  // namespace

Suspension::Seen Suspension::look(const Particles& grains, std::size_t i, const Around& at) const {
  Seen out{};
  const double d = 2 * grains.data<Field::radius>()[i], in_cell = 1 / cells_.volume();
  const double solid = grid_.mean(at.kernel, centres, seen_.solid);
  const double own_solid = at.volume * in_cell * GrainGrid::own(at.kernel, centres);
  const double alone = scene_->grains.drag.own_disturbance ? unscreened(solid_around(solid, own_solid)) : 0.0;
  const double eta = grid_.mean(at.kernel, centres, seen_.melt_viscosity);
  const double thick = grid_.mean(at.kernel, centres, seen_.viscosity);
  constexpr double least_porosity = 0.2;
  const double porosity = std::clamp(1 - solid + alone * own_solid, least_porosity, 1.0);
  const double zeta = scene_->grains.drag.law->resistance({porosity, 0, 0, eta, d});
  const double own = std::min(alone * self_mobility / (thick * size_.cell), most_own / zeta);
  for (int a = 0; a < 3; ++a) {
    const auto k = static_cast<std::size_t>(a), b = (k + 1) % 3, c = (k + 2) % 3;
    out.velocity[k] = grid_.mean(at.kernel, a, seen_.velocity[k]);
    out.curl[k] = grid_.slope(at.kernel, static_cast<int>(c), seen_.velocity[c], static_cast<int>(b)) -
                  grid_.slope(at.kernel, static_cast<int>(b), seen_.velocity[b], static_cast<int>(c));
    const double force = at.weight[k] + grains.data<Field::contact_force>()[3 * i + k];
    const double of_others =
        grid_.mean(at.kernel, a, seen_.force[k]) - alone * force * in_cell * GrainGrid::own(at.kernel, a);
    out.slip[k] = (at.weight[k] - at.volume * of_others) / zeta - own * at.weight[k];
  }
  out.mobility = 1 / zeta - own;
  const double mixture =
      eta * (thick > eta ? std::min(thick / eta, 1 / (porosity * porosity * porosity)) : 1.0);
  out.spin_mobility = 1 / (std::numbers::pi * mixture * (d * d * d));
  return out;
}

void Suspension::see_flow(StepState& s) {
  if (!melt_->is_due(s.global)) return;
  using Behind = GrainGrid::Behind;
  Particles& grains = s.particles;
  const Suspended& of = *melt_->work().suspended;
  const stokes::Velocity& u = melt_->work().flow.u;
  const std::array<GrainGrid::Copied, 8> all{
      {{&u[0], 0, Behind::velocity, seen_.velocity.data()},
       {&u[1], 1, Behind::velocity, &seen_.velocity[1]},
       {&u[2], 2, Behind::velocity, &seen_.velocity[2]},
       {of.force.data(), 0, Behind::force, seen_.force.data()},
       {&of.force[1], 1, Behind::force, &seen_.force[1]},
       {&of.force[2], 2, Behind::force, &seen_.force[2]},
       {&of.solid, centres, Behind::same, &seen_.solid},
       {&melt_->work().thick, centres, Behind::same, &seen_.viscosity}}};
  grid_.copy(all, melt_->work().patch());
  std::array<GrainGrid::Deposit, 3> sums{grid_.make_deposit(), grid_.make_deposit(), grid_.make_deposit()};
  double* free = grains.data<Field::free_velocity>();
  double* spin = grains.data<Field::free_spin>();
  double* mobility = grains.data<Field::mobility>();
  std::vector<Double3> slip(grains.owned());  // times the volume
  double largest = 0;
  for (std::size_t i = 0; i < grains.owned(); ++i) {
    const Around at = around(grains, i);
    const Seen seen = look(grains, i, at);
    mobility[2 * i] = seen.mobility;
    mobility[2 * i + 1] = seen.spin_mobility;
    for (std::size_t a = 0; a < 3; ++a) {
      const double of_contacts = seen.mobility * grains.data<Field::contact_force>()[3 * i + a];
      free[3 * i + a] = seen.velocity[a] + seen.slip[a];
      if (spin != nullptr) spin[3 * i + a] = 0.5 * seen.curl[a];
      slip[i][a] = at.volume * (seen.slip[a] + of_contacts);
      largest = std::isnan(slip[i][a]) ? slip[i][a] : std::max(largest, std::fabs(slip[i][a]));
      grains.data<Field::way>()[3 * i + a] = 0;
    }
  }
  const double unit = unit_of(s.global, largest);
  for (std::size_t i = 0; i < grains.owned(); ++i) {
    const GridKernel kernel = grid_.kernel(grains.data<Field::position>() + 3 * i);
    for (std::size_t a = 0; a < 3; ++a) grid_.spread(kernel, static_cast<int>(a), slip[i][a] / unit, sums[a]);
  }
  stokes::Velocity back = {};
  const double per_cell = unit / cells_.volume();
  const std::array<GrainGrid::Folded, 3> folded{{{sums.data(), 0, back.data(), per_cell, true},
                                                 {&sums[1], 1, &back[1], per_cell, true},
                                                 {&sums[2], 2, &back[2], per_cell, true}}};
  grid_.fold(folded, melt_->work().patch());
  const std::array<GrainGrid::Copied, 3> copied{{{back.data(), 0, Behind::flux, seen_.slip.data()},
                                                 {&back[1], 1, Behind::flux, &seen_.slip[1]},
                                                 {&back[2], 2, Behind::flux, &seen_.slip[2]}}};
  grid_.copy(copied, melt_->work().patch());
  for (std::size_t i = 0; i < grains.owned(); ++i) {
    const GridKernel kernel = grid_.kernel(grains.data<Field::position>() + 3 * i);
    for (int a = 0; a < 3; ++a)
      free[3 * i + static_cast<std::size_t>(a)] -=
          grid_.mean(kernel, a, seen_.slip[static_cast<std::size_t>(a)]);
  }
  share_interval(s);
}

// An overdamped contact of stiffness k relaxes at the rate 2 k mobility; explicit steps are monotone up to one over it.
// With friction surfaces move by spin, too, and rolling springs turn alone.
void Suspension::share_interval(const StepState& s) {
  const Particles& grains = s.particles;
  double rolling = 0;
  for (const Group& g : scene_->groups)
    if (g.kind == GroupKind::grain) rolling = std::max(rolling, g.grain.rolling_friction);
  for (const ContactPair& p : scene_->grains.contact.pairs)
    rolling = std::max(rolling, p.rolling_friction.value_or(0));
  std::array<double, 3> rates{};  // of contacts, of grains through cells, of grains past each other [1/s]
  for (std::size_t i = 0; i < grains.owned(); ++i) {
    const double r = grains.data<Field::radius>()[i];
    const double* v = grains.data<Field::free_velocity>() + 3 * i;
    const double* f = grains.data<Field::contact_force>() + 3 * i;
    const double moves = grains.data<Field::mobility>()[2 * i],
                 turns = grains.data<Field::mobility>()[2 * i + 1];
    const double normal = static_cast<double>(of_.stiffness[i][0]) * unit_.stiffness;
    const double tangential = static_cast<double>(of_.stiffness[i][1]) * unit_.stiffness;
    rates[0] = std::max({rates[0], 2 * moves * std::max(normal, size_.to_come),
                         2 * (moves + turns * r * r) * tangential,
                         2 * 2.25 * rolling * rolling * r * r * turns * normal});
    double cells = 0, v2 = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double now = v[a] + moves * f[a];
      cells += std::fabs(now) / cells_.edge[a];
      v2 += now * now;
    }
    rates[1] = std::max(rates[1], cells);
    rates[2] = std::max(rates[2], std::sqrt(v2));
  }
  comm_->max(rates);
  FlowClock& clock = s.global.flow;
  clock.interval = std::min(clock.interval, scene_->domain.melt.courant / rates[1]);
  if (!(clock.interval > 0 && std::isfinite(clock.interval)))
    throw GuardError(step_text(s.global.step) +
                     (clock.interval > 0
                          ? "nothing flows, and there is no time.dt: give one"
                          : "the slow flow is not finite: check densities, viscosities and melt.expansion"));
  const double shortest = std::max(rates[0], rates[2] / (way_of_step * size_.least_radius));
  const double steps = std::max(1.0, std::ceil(clock.interval * shortest));
  if (!(steps < most_steps))
    throw GuardError(
        fmt::format("{}contacts relax in {:.3g} s, and the flow would wait for {:.3g} steps of them; "
                    "reduce the stiffness of grains, or time.dt",
                    step_text(s.global.step), 1 / shortest, steps));
  clock.left = static_cast<std::int64_t>(steps);
  s.global.dt = clock.interval / steps;
}

}  // namespace sph
