#include "sph/models/drag.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sph/laws/drag/law.hpp"
#include "sph/models/models.hpp"
#include "sph/models/physics.hpp"
#include "sph/scene/grain_mass.hpp"

namespace sph {
bool has_drag(const Scene& scene) {
  return scene.is_mixture() && scene.grains.drag.law->resistance != nullptr;
}

Drag::Drag(std::size_t fluid, std::size_t grains, const Scene& scene, const PositionScale& scale,
           const SphConstants& constants)
    : Model(grains),
      SetPair(grains, fluid),
      scene_(&scene),
      constants_(&constants),
      push_(scene),
      near_(scene, scale, constants) {
  const DragLaw& law = *scene.grains.drag.law;
  // As if it took the heaviest grain, or the fluid in its place, to the speed of sound within h, or dragged a grain
  // in a packed bed with that speed.
  double largest = 0;
  PushLimits packed;
  const double sound = *std::ranges::max_element(constants.groups.sound_speed);
  for (const Group& g : scene.groups) {
    if (g.kind != GroupKind::grain || !(g.grain.largest_radius > 0)) continue;
    for (const Group& f : scene.groups) {
      if (f.kind != GroupKind::fluid) continue;
      const double heavy = grain_mass(std::max(g.density, f.density), g.grain.largest_radius);
      const double fast =
          law.resistance({DragForce::packed, sound, f.density, f.viscosity, 2 * g.grain.largest_radius});
      largest = std::max({largest, heavy * sound * sound / scene.kernel.smoothing_length, fast * sound});
      const double d = 2 * g.grain.least_radius, volume = volume_of(g.grain.least_radius);
      const double zeta = law.resistance({DragForce::packed, 0, f.density, f.viscosity, d});
      const double solid = (1 - DragForce::packed) / DragForce::packed;
      packed.rate = std::max(packed.rate, zeta * solid / (volume * f.density));
      const double lighter = g.grain.fixed ? 0.0 : solid * f.density / g.density;
      packed.sound = std::max(packed.sound, sound * std::sqrt(1 + lighter));
    }
  }
  force_quantum_ = std::ldexp(1.0, std::ilogb(largest) + 1 - 50);
  first_step_ = step_of(packed);
}

// It is that of what walls leave of the kernel, whose share is known before.
void Drag::add_porosity_to(Plan& fluid) {
  for (const std::vector<Entry>* part : {&fluid.sums, &fluid.kick})
    fluid_is_displaced_ |= first_that_writes(*part, Field::position) != part->end();
  Stage porosity{
      "porosity", decomp::Region::contacts, {}, {Field::porosity}, [this](StepState& s, Side side) {
        deposit_porosity(s, side);
      }};
  porosity.set = other();
  porosity.other = {set(), {Field::position}};
  Stage fill{"fluid between grains",
             decomp::Region::update,
             {},
             {Field::mass, Field::density},
             [this](StepState& s, Side) { fill_between_grains(s); }};
  fill.set = other();
  const auto wall_share = first_that_writes(fluid.sums, Field::wall_share);
  if (wall_share != fluid.sums.end()) fluid.settle.push_back(*wall_share);
  append(fluid.settle, porosity);
  append(fluid.settle, fill);
  fluid.sums.insert(first_that_writes(fluid.sums, Field::density), Entry{{std::move(porosity)}, {}, {}});
}

Plan Drag::force_plan() {
  Plan plan;
  Stage on_grains{"fluid on grains",
                  decomp::Region::contacts,
                  {},
                  FieldSet{Field::velocity} | of_grains,
                  [this](StepState& s, Side side) { push_grains(s, side); }};
  on_grains.set = set();
  on_grains.other = {other(),
                     {Field::position, Field::velocity, Field::density, Field::mass, Field::group,
                      Field::force, Field::porosity, Field::liquid_density, Field::sound_speed}};
  Stage on_fluid{"grains on fluid",
                 decomp::Region::contacts,
                 {},
                 {Field::velocity, Field::grain_pull, Field::grain_drag},
                 [this](StepState& s, Side side) { push_fluid(s, side); }};
  on_fluid.set = other();
  on_fluid.other = {set(), FieldSet{Field::position} | of_grains};
  append(plan.kick, on_grains);
  append(plan.kick, on_fluid);
  return plan;
}

// Nothing in it moves before the first step.
double Drag::start(const decomp::Comm&, Particles&, GlobalState&) {
  return scene_->time.dt ? *scene_->time.dt : first_step_;
}

bool Drag::report(const StepState&, Reduction& reduction) {
  reduction[rate_] = limits_.rate;
  reduction[sound_] = limits_.sound;
  return true;
}

double Drag::longest_step(const Reduction& reduction) const {
  if (scene_->time.dt) return *scene_->time.dt;
  return step_of({reduction[rate_], reduction[sound_]});
}

// Sound in the fluid alone has the scene's own share of h; in the mixture it may have a little more.
double Drag::step_of(const PushLimits& limits) const {
  const double cfl = std::max(scene_->time.cfl, std::min(1.25 * scene_->time.cfl, 1.0));
  double dt = std::numeric_limits<double>::infinity();
  if (limits.rate > 0) dt = DragForce::usual_share / limits.rate;
  if (limits.sound > 0) dt = std::min(dt, cfl * scene_->kernel.smoothing_length / limits.sound);
  return dt;
}

void Drag::guard_step(const Reduction& reduction, const GlobalState& global) const {
  const double h = scene_->kernel.smoothing_length;
  if (reduction[rate_] * global.dt > DragForce::largest_share)
    throw GuardError(fmt::format(
        "{}grains take the fluid along within {:.3g} s, less than a time step; set time.dt to {:.3g} s or "
        "less",
        step_text(global.step), 1 / reduction[rate_], 0.9 * DragForce::usual_share / reduction[rate_]));
  if (reduction[sound_] * global.dt > courant_limit(*scene_) * h)
    throw GuardError(
        fmt::format("{}sound, which grains lighter than the fluid make faster, passes {:.3g} m in a time "
                    "step, more than {} "
                    "times the smoothing length; set time.dt to {:.3g} s or less",
                    step_text(global.step), reduction[sound_] * global.dt, courant_limit(*scene_),
                    0.9 * courant_recommended * h / reduction[sound_]));
}

}  // namespace sph
