#include "sph/models/suspension.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/grain_constants.hpp"
#include "models/grain_texts.hpp"
#include "sph/core/exact_math.hpp"
#include "sph/core/findings.hpp"
#include "sph/laws/contact/law.hpp"
#include "sph/models/contact_stiffness.hpp"
#include "sph/models/drag_force.hpp"
#include "sph/models/grain_limits.hpp"
#include "sph/scene/melt_grid.hpp"

namespace sph {
namespace {

constexpr double volume_unit = 0x1p-50;  // of a cell
constexpr double most_cells = 1;         // of a grain until the next flow, in cells
constexpr double contacts_to_come = 2;   // springs that a grain will touch before the next flow, at least
constexpr double usual_overlap = 0.1;    // over the largest that is allowed

double least_radius(const Scene& scene) {
  double least = scene.largest_diameter();
  for (const Group& g : scene.groups)
    if (g.grain.least_radius > 0) least = std::min(least, g.grain.least_radius);
  return least;
}

}  // namespace

FieldSet Suspension::fields(const Scene& scene) {
  FieldSet out{Field::free_velocity, Field::mobility, Field::contact_force, Field::way};
  if (contact_fusion(scene).spins) out |= FieldSet{Field::free_spin};
  return out;
}

Suspension::Suspension(std::size_t grains, std::size_t cells, const decomp::Comm& comm, const Scene& scene,
                       const PositionScale& scale, const Grains& contacts, Melt& melt)
    : Model(grains),
      SetPair(grains, cells),
      comm_(&comm),
      scene_(&scene),
      scale_(scale),
      contacts_(&contacts),
      melt_(&melt),
      cells_(melt_grid(scene)),
      grid_(comm, cells_, scale, domain_length(scene, scale), melt.rows().boxes()) {
  const double r = 0.5 * scene.largest_diameter();
  size_.cell = exact_pow(cells_.volume(), 1.0 / 3);
  unit_.stiffness = std::ldexp(1.0, std::ilogb(stiffest_contact(scene, r)) + 1 - 50);
  size_.least_radius = least_radius(scene);
  size_.to_come =
      contacts_to_come * stiffest_contact(scene, r, usual_overlap * scene.grains.contact.largest_overlap);
}

double Suspension::start(const decomp::Comm&, Particles& grains, GlobalState&) {
  for (const Field f : fields(*scene_).list())
    std::fill_n(grains.table().column(grains.column(f)).data(), grains.owned() * width(f, scene_->dim),
                std::byte{});
  return scene_->time.dt.value_or(any_step);
}

Plan Suspension::plan() {
  const auto stage = [](std::string name, std::size_t set, std::size_t other, FieldSet writes, auto work) {
    Stage s{std::move(name), decomp::Region::grid, {}, writes, [work](StepState& state, Side side) {
              if (side != Side::interior) work(state);
            }};
    s.set = set;
    s.other = {other, {}};
    return s;
  };
  Plan of_melt = melt_->plan();
  for (auto part : {&Plan::sums, &Plan::kick})
    for (Entry& e : of_melt.*part)
      for (Stage& s : e.stages) s.set = other();
  Plan plan;
  Stage down = stage("grains on cells", set(), other(), {}, [this](StepState& s) { spread(s); });
  down.refresh = {Field::position};
  append(plan.sums, std::move(down));
  append(plan, of_melt);
  plan.kick.clear();
  append(plan.sums, stage("flow at grains", set(), other(), fields(*scene_) | FieldSet{Field::velocity},
                          [this](StepState& s) { see_flow(s); }));
  append(plan.kick, stage("ways on cells", set(), other(), {}, [this](StepState& s) { spread_ways(s); }));
  for (Entry& e : of_melt.kick) plan.kick.push_back(e);
  return plan;
}

// A grain may have left where lists were made by half a skin and a step, and on its way since the last flow it was at
// most a cell away.
void Suspension::rebuild(const Particles&, const ListSetting& s, decomp::Payload&,
                         std::span<const std::uint32_t>) {
  grid_.follow(s.partition, 0.5 * s.skin + longest_grain_move(*scene_) +
                                most_cells * *std::ranges::max_element(cells_.edge));
}

Suspension::Around Suspension::around(const Particles& grains, std::size_t i) const {
  Around at{grid_.kernel(grains.data<Field::position>() + 3 * i), volume_of(grains.data<Field::radius>()[i]),
            of_.excess[i]};
  for (std::size_t a = 0; a < 3; ++a) at.weight[a] = at.volume * at.excess * scene_->domain.gravity[a];
  return at;
}

// Cells add integers: 2^40 for the largest of all grains, of which a cell may have millions.
double Suspension::unit_of(const GlobalState& global, double largest) const {
  std::array<double, 1> all{std::isnan(largest) ? std::numeric_limits<double>::infinity() : largest};
  comm_->max(all);
  if (!std::isfinite(all[0]))
    throw GuardError(step_text(global.step) +
                     "forces of grains in melts are not finite: check densities, stiffnesses and time.dt");
  return all[0] > 0 ? std::ldexp(1.0, std::max(std::ilogb(all[0]) - 39, -1022)) : 1.0;
}

/// Sets the excess of each grain, and the unit of what drives them.
void Suspension::weigh(const GlobalState& global, const Particles& grains) {
  of_.excess.resize(grains.owned());
  double largest = 0;
  for (std::size_t i = 0; i < grains.owned(); ++i) {
    const GridKernel kernel = grid_.kernel(grains.data<Field::position>() + 3 * i);
    of_.excess[i] =
        scene_->groups[grains.data<Field::group>()[i]].density - grid_.mean(kernel, centres, seen_.density);
    const double weight = volume_of(grains.data<Field::radius>()[i]) * of_.excess[i];
    for (std::size_t a = 0; a < 3; ++a) {
      const double force = std::fabs(weight * scene_->domain.gravity[a]) +
                           std::fabs(grains.data<Field::contact_force>()[3 * i + a]);
      largest = std::isnan(force) ? force : std::max(largest, force);
    }
  }
  unit_.force = unit_of(global, largest);
}

void Suspension::spread(const StepState& s) {
  if (!melt_->is_due(s.global)) return;
  const Particles& grains = s.particles;
  melt_->load(*s.other);
  const stokes::Field density = melt_->work().densities(), viscosity = melt_->work().viscosities();
  const std::array<GrainGrid::Copied, 2> of_melt{
      {{&density, centres, GrainGrid::Behind::same, &seen_.density},
       {&viscosity, centres, GrainGrid::Behind::same, &seen_.melt_viscosity}}};
  grid_.copy(of_melt, melt_->work().patch());
  of_.stiffness = stiffness_of_rows(*scene_, contacts_->pairs().lists(), grains, contacts_->table(),
                                    contacts_->walls().now(s.global).planes, scale_.quantum, unit_.stiffness);
  weigh(s.global, grains);
  std::array<GrainGrid::Deposit, 6> sums;
  for (GrainGrid::Deposit& d : sums) d = grid_.make_deposit();
  auto& [solid, excess, stiffness, fx, fy, fz] = sums;
  const double in_cell = 1 / (cells_.volume() * volume_unit);
  const double heaviest = std::ranges::max(scene_->groups, {}, &Group::density).density;
  for (std::size_t i = 0; i < grains.owned(); ++i) {
    const Around at = around(grains, i);
    const double volume = at.volume * in_cell, d = 2 * grains.data<Field::radius>()[i];
    grid_.spread(at.kernel, centres, volume, solid);
    grid_.spread(at.kernel, centres, volume * at.excess / heaviest, excess);
    // Half of a contact's (k_n + 3/2 k_t) d^2 / 15 is each partner's; d^2 / 15 comes with the unit.
    const double k =
        static_cast<double>(of_.stiffness[i][0]) + 1.5 * static_cast<double>(of_.stiffness[i][1]);
    const double share = d / scene_->largest_diameter();
    grid_.spread(at.kernel, centres, 0.5 * k * (share * share) * 0x1p-10, stiffness);
    const double* contacts = grains.data<Field::contact_force>() + 3 * i;
    grid_.spread(at.kernel, 0, (at.weight[0] + contacts[0]) / unit_.force, fx);
    grid_.spread(at.kernel, 1, (at.weight[1] + contacts[1]) / unit_.force, fy);
    grid_.spread(at.kernel, 2, (at.weight[2] + contacts[2]) / unit_.force, fz);
  }
  Suspended& to = *melt_->work().suspended;
  const double d = scene_->largest_diameter(), per_volume = 1 / cells_.volume();
  const std::array<GrainGrid::Folded, 6> folded{
      {{&solid, centres, &to.solid, volume_unit},
       {&excess, centres, &to.excess, volume_unit * heaviest},
       {&stiffness, centres, &to.stiffness, unit_.stiffness * 0x1p10 * (d * d / 15) * per_volume},
       {&fx, 0, to.force.data(), unit_.force * per_volume},
       {&fy, 1, &to.force[1], unit_.force * per_volume},
       {&fz, 2, &to.force[2], unit_.force * per_volume}}};
  grid_.fold(folded, melt_->work().patch());
}

void Suspension::act(const Reduction&, GlobalState& global) {
  const bool last = melt_->is_last(global);
  global.flow.left = last ? 0 : global.flow.left - 1;
  next_step_ = last ? global.flow.interval : global.dt;
}

void Suspension::spread_ways(const StepState& s) {
  if (!melt_->is_last(s.global)) return;
  melt_->load(*s.other);  // a run that is resumed has not looked at the cells yet
  const Particles& grains = s.particles;
  std::array<GrainGrid::Deposit, 4> sums;
  for (GrainGrid::Deposit& d : sums) d = grid_.make_deposit();
  auto& [solid, jx, jy, jz] = sums;
  const std::int64_t* x = grains.data<Field::position>();
  const std::int64_t* way = grains.data<Field::way>();
  const double in_cell = 1 / (cells_.volume() * volume_unit);
  Findings far;
  for (std::size_t i = 0; i < grains.owned(); ++i) {
    std::array<std::int64_t, 3> before{};
    bool too_far = false;
    for (std::size_t a = 0; a < 3; ++a) {
      before[a] = x[3 * i + a] - way[3 * i + a];
      too_far = too_far || std::fabs(scale_.metres(way[3 * i + a])) > most_cells * cells_.edge[a];
    }
    if (too_far) {
      const std::uint64_t id = grains.data<Field::id>()[i];
      far.add(id, [&] {
        return fmt::format(
            "grain {} {} went further than a cell since the flow was found: reduce melt.courant or "
            "time.dt",
            id, text_of_place(*scene_, scale_, x + 3 * i));
      });
      continue;
    }
    const double volume = volume_of(grains.data<Field::radius>()[i]) * in_cell;
    const GridKernel from = grid_.kernel(before.data());
    grid_.spread(from, centres, volume, solid);
    grid_.spread_way(from, grid_.kernel(x + 3 * i), volume, {&jx, &jy, &jz});
  }
  far.stop(*comm_, step_text(s.global.step));
  Suspended& to = *melt_->work().suspended;
  const std::array<GrainGrid::Folded, 4> folded{{{&solid, centres, &to.solid, volume_unit},
                                                 {&jx, 0, to.passed.data(), volume_unit, true},
                                                 {&jy, 1, &to.passed[1], volume_unit, true},
                                                 {&jz, 2, &to.passed[2], volume_unit, true}}};
  grid_.fold(folded, melt_->work().patch());
}

}  // namespace sph
