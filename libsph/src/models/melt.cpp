#include "sph/models/melt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "decomp/exact_sum.hpp"
#include "sph/core/exact_math.hpp"
#include "sph/core/findings.hpp"
#include "sph/scene/melt_grid.hpp"
#include "stokes/partition.hpp"

namespace sph {
namespace {

constexpr double least_force = 1e-10;  // of the weight: less is what rounding leaves where all is at rest
constexpr double usual_iterations = 20;
constexpr double grids_and_scratch = 24;  // numbers of each component of a cell
constexpr double longer = 1.25;           // than the last flow's interval no next one is by more

/// A tenth of the time in which heat crosses the domain [s].
double conduction_step(const Scene& scene) {
  const Domain& domain = scene.domain;
  double width = domain.upper[0] - domain.lower[0];
  for (std::size_t a = 1; a < static_cast<std::size_t>(scene.dim); ++a)
    width = std::min(width, domain.upper[a] - domain.lower[a]);
  return 0.1 * width * width / domain.melt.diffusivity;
}

double cells_of(const stokes::Grid& g) { return static_cast<double>(g.cells[0] * g.cells[1] * g.cells[2]); }

/// The shortest theta scheme that makes no new extrema, of second order for short steps.
double implicitness(const stokes::Grid& g, double diffusivity, double dt) {
  double share = 0;
  for (std::size_t a = 0; a < static_cast<std::size_t>(g.dim); ++a)
    share += 3 * diffusivity * dt / (g.edge[a] * g.edge[a]);  // at walls; inside 2
  return std::max(0.5, 1 - 1 / std::max(share, 1.0));
}

std::string not_finite(const GlobalState& global) {
  return step_text(global.step) +
         "the slow flow is not finite: check densities, viscosities, gravity, melt.expansion and stiffnesses";
}

}  // namespace

Melt::Melt(std::size_t set, const decomp::Comm& comm, const Scene& scene, const PositionScale& scale)
    : Model(set),
      comm_(&comm),
      scene_(&scene),
      scale_(scale),
      rows_(melt_grid(scene), scale, stokes::even_boxes(melt_grid(scene), comm.size())),
      has_grains_(scene.has_grains()) {}

FieldSet Melt::fields(const Scene& scene) {
  FieldSet f{Field::id,    Field::position,      Field::velocity,  Field::mass,
             Field::group, Field::flow_pressure, Field::melt_share};
  if (scene.domain.melt.diffusivity > 0) f |= FieldSet{Field::temperature};
  if (const auto [first, last] = melts_of(scene); first != last) f |= FieldSet{Field::composition};
  return f;
}

double Melt::bytes_of_cell() const {
  const int d = scene_->dim;
  // Krylov vectors, two of D + 1 numbers an iteration; coarse grids are less than half of the finest.
  const double vectors =
      2 * std::min<double>(static_cast<double>(scene_->domain.melt.most_iterations), usual_iterations);
  return 8 * ((vectors + grids_and_scratch) * (d + 1));
}

Plan Melt::plan() {
  const auto stage = [](std::string name, FieldSet writes, auto work) {
    return Stage{std::move(name), decomp::Region::grid, {}, writes, [work](StepState& s, Side) { work(s); }};
  };
  Plan plan;
  append(plan.sums,
         stage("flow", {Field::velocity, Field::flow_pressure}, [this](StepState& s) { flow(s); }));
  append(plan.kick, stage("heat and composition", {Field::temperature, Field::composition, Field::melt_share},
                          [this](StepState& s) { carry(s); }));
  return plan;
}

bool Melt::report(const StepState& state, Reduction& reduction) {
  reduction[courant_rate_] = scene_->domain.melt.courant / courant_step_;
  double beyond = 0;
  if (const double* c = state.particles.data<Field::composition>())
    for (std::size_t i = 0; i < state.particles.owned(); ++i)
      beyond = std::max(beyond, std::fabs(c[i] - 0.5) - 0.5);
  reduction[beyond_] = beyond;
  return std::isfinite(state.global.dt);
}

// Transport makes no new extrema unless cells are emptied: at rest, in endless steps, by what rounding leaves.
void Melt::guard_step(const Reduction& reduction, const GlobalState& global) const {
  constexpr double most = 0.01;
  if (reduction[beyond_] > most)
    throw GuardError(
        fmt::format("{}a cell has {:.3g} more of a melt than all of it, or less than none: what the solver "
                    "leaves of a flow at rest carries it away; give time.dt",
                    step_text(global.step), reduction[beyond_]));
}

double Melt::longest_step(const Reduction& reduction) const {
  return std::min(scene_->time.dt.value_or(any_step), scene_->domain.melt.courant / reduction[courant_rate_]);
}

bool Melt::is_last(const GlobalState& global) const { return !has_grains_ || global.flow.left <= 1; }

MeltWork& Melt::load(const Particles& cells) {
  if (!work_) work_ = std::make_unique<MeltWork>(*comm_, *scene_, rows_.boxes());
  rows_.find(cells, work_->patch());
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene_->dim); ++a)
    rows_.load(cells, Field::velocity, work_->flow.u[a], a);
  rows_.load(cells, Field::flow_pressure, work_->flow.p);
  rows_.load(cells, Field::melt_share, work_->share);
  if (cells.has(Field::temperature)) rows_.load(cells, Field::temperature, work_->temperature);
  if (cells.has(Field::composition)) rows_.load(cells, Field::composition, work_->composition);
  return *work_;
}

void Melt::flow(StepState& state) {
  if (!is_due(state.global)) return;
  const MeltControl& m = scene_->domain.melt;
  load(state.particles);
  const stokes::Patch& p = work_->patch();
  work_->solver.refresh(work_->composition);
  stokes::Field rho = work_->densities();
  work_->solver.refresh(rho);
  FlowClock& clock = state.global.flow;
  const double before = has_grains_ ? clock.interval : std::isfinite(state.global.dt) ? state.global.dt : 0.0;
  stokes::Field eta = work_->viscosities();
  if (has_grains_) {
    work_->solver.refresh(work_->suspended->excess);
    work_->thicken(eta, before);
    work_->thick = eta;
    if (state.global.step == 0)
      stokes::for_own(p, [&](std::size_t k) { work_->share[k] = 1 - work_->suspended->solid[k]; });
  }
  const double settled = settling_step(state.global, rho, eta);
  work_->solver.set_viscosity(std::move(eta), work_->stratification(before));
  // What the tolerance left in cells flows out of them in the next step.
  stokes::Field source(p.size, 0.0);
  if (before > 0)
    stokes::for_own(p, [&](std::size_t k) {
      source[k] = (work_->share[k] + (has_grains_ ? work_->suspended->solid[k] : 0.0) - 1) / before;
    });
  double g2 = 0;
  for (const double g : scene_->domain.gravity) g2 += g * g;
  const double weight = scene_->groups[melts_of(*scene_)[0]].density * std::sqrt(g2 * cells_of(p.grid));
  const stokes::Effort effort =
      work_->solver.solve(work_->driving_force(rho), work_->flow, m.tolerance,
                          static_cast<int>(m.most_iterations), &source, least_force * weight);
  if (std::isnan(effort.residual)) throw GuardError(not_finite(state.global));
  if (!effort.converged)
    throw GuardError(fmt::format(
        "{}the slow flow has a residual of {:.3g} after {} iterations, wanted {}: viscosities may "
        "differ too sharply, raise melt.most_iterations or melt.tolerance",
        step_text(state.global.step), effort.residual, effort.iterations, m.tolerance));
  clock.iterations = effort.iterations;
  clock.residual = effort.residual;
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene_->dim); ++a)
    rows_.store(work_->flow.u[a], Field::velocity, state.particles, a);
  rows_.store(work_->flow.p, Field::flow_pressure, state.particles);
  courant_step_ =
      std::min({work_->transport.longest_step(work_->flow.u, m.courant), conduction_step(*scene_), settled});
  if (has_grains_) {  // Suspension shares it out
    clock.interval = std::min(scene_->time.dt.value_or(any_step), courant_step_);
    if (before > 0) clock.interval = std::min(clock.interval, longer * before);
    rows_.store(work_->share, Field::melt_share, state.particles);
    return;
  }
  state.global.dt = std::min(state.global.dt, courant_step_);
  if (!std::isfinite(state.global.dt) || !(state.global.dt > 0))
    throw GuardError(state.global.dt > 0
                         ? step_text(state.global.step) + "nothing flows, and there is no time.dt: give one"
                         : not_finite(state.global));
}

// What lies a off its layer is driven by about f = drho g a / L and comes back at f L^2 / (pi^2 eta), a times drho g L /
// (pi^2 eta); so much of it as the tolerance is what the solver leaves unknown. A tenth of the time in which that goes as
// far as a is the longest step: in a longer one a flow at rest would throw melts further off than they are.
double Melt::settling_step(const GlobalState& global, const stokes::Field& rho,
                           const stokes::Field& eta) const {
  constexpr double most = std::numeric_limits<double>::infinity();
  // - least density of the melt, - least and largest viscosity, - least and largest density with grains
  std::array<double, 5> ends{-most, -most, -most, -most, -most};
  stokes::for_own(work_->patch(), [&](std::size_t k) {
    const double all = rho[k] + (has_grains_ ? work_->suspended->excess[k] : 0.0);
    const std::array here{-rho[k], -eta[k], eta[k], -all, all};
    for (std::size_t e = 0; e < ends.size(); ++e) ends[e] = std::max(ends[e], here[e]);
  });
  comm_->max(ends);
  if (has_grains_ && !(ends[0] < 0))  // without grains only differences of density count
    throw GuardError(
        fmt::format("{}a melt's density is {:.4g} kg/m^3: melt.expansion is too much for so warm a "
                    "melt, reduce it or raise melt.reference_temperature",
                    step_text(global.step), -ends[0]));
  // The solver squares viscosities and divides by them.
  constexpr double least_viscosity = 1e-100, most_viscosity = 1e100;
  if (!(-ends[1] >= least_viscosity && ends[2] <= most_viscosity))
    throw GuardError(
        fmt::format("{}viscosities are {:.4g} to {:.4g} Pa s, springs of grains included: check "
                    "those of melts, melt.viscosity_fall and normal_stiffness",
                    step_text(global.step), -ends[1], ends[2]));
  constexpr double share = 0.1 * std::numbers::pi * std::numbers::pi;
  double g2 = 0, length = 0;
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene_->dim); ++a) {
    g2 += scene_->domain.gravity[a] * scene_->domain.gravity[a];
    length = std::max(length, scene_->domain.upper[a] - scene_->domain.lower[a]);
  }
  const double pull = scene_->domain.melt.tolerance * (ends[3] + ends[4]) * std::sqrt(g2) * length;
  return pull > 0 ? share * -ends[1] / pull : most;
}

// Half of the conduction, what the flow carries, the other half (Strang 1968): steady states keep the second order.
void Melt::carry(StepState& state) {
  if (!is_last(state.global)) return;
  const double dt = has_grains_ ? state.global.flow.interval : state.global.dt;
  const bool two = state.particles.has(Field::composition);
  std::vector<stokes::Carried> with_all, with_melt;
  if (work_->conduction)
    (has_grains_ ? with_all : with_melt).push_back({&work_->temperature, &*work_->conduction});
  if (two) with_melt.push_back({&work_->composition});
  stokes::Field both = work_->share;  // melt and grains have one temperature
  if (has_grains_)
    stokes::for_own(work_->patch(), [&](std::size_t k) { both[k] += work_->suspended->solid[k]; });
  const auto conduct = [&](const stokes::Field& volume) {
    if (!work_->conduction) return;
    const double theta = implicitness(work_->patch().grid, scene_->domain.melt.diffusivity, 0.5 * dt);
    (void)work_->conduction->advance(0.5 * dt, work_->temperature, theta, &volume);
  };
  conduct(both);
  if (has_grains_) advect_beside_grains(dt, both, with_all);
  work_->transport.advect(work_->flow.u, dt, work_->share, with_melt);
  conduct(has_grains_ ? both : work_->share);
  if (work_->conduction) rows_.store(work_->temperature, Field::temperature, state.particles);
  if (two) rows_.store(work_->composition, Field::composition, state.particles);
  rows_.store(work_->share, Field::melt_share, state.particles);
}

// Heat is that of both, who share a volume that stays; the melt's own flux is what grains leave of that of both.
void Melt::advect_beside_grains(double dt, stokes::Field& both, std::span<const stokes::Carried> with_all) {
  if (!with_all.empty()) work_->transport.advect(work_->flow.u, dt, both, with_all);
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene_->dim); ++a) {
    const double speed = work_->patch().grid.edge[a] / dt;
    stokes::for_own(work_->patch(),
                    [&](std::size_t k) { work_->flow.u[a][k] -= speed * work_->suspended->passed[a][k]; });
  }
}

}  // namespace sph
