#include "sph/models/melt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "decomp/exact_sum.hpp"
#include "sph/core/exact_math.hpp"
#include "sph/core/findings.hpp"
#include "sph/scene/melt_grid.hpp"
#include "stokes/partition.hpp"

namespace sph {
namespace {

constexpr std::array side_names{"x0", "x1", "y0", "y1", "z0", "z1"};
constexpr double least_force = 1e-10;  // of the weight: less is what rounding leaves where all is at rest
constexpr double usual_iterations = 20;
constexpr double grids_and_scratch = 24;  // numbers of each component of a cell

template <class Work>
void for_cells(const stokes::Patch& p, Work work) {
  stokes::for_lines(p, [&](std::ptrdiff_t first, std::int64_t n, std::int64_t, std::int64_t) {
    for (std::ptrdiff_t k = first; k < first + n; ++k) work(static_cast<std::size_t>(k));
  });
}

stokes::ThermalWalls walls_of(const Scene& scene) {
  stokes::ThermalWalls walls{};
  for (const MeltSide& s : scene.domain.melt.sides) {
    const auto face = static_cast<std::size_t>(s.side);
    stokes::ThermalWall& wall = walls[face / 2][face % 2];
    if (s.temperature) wall = {stokes::ThermalWall::Kind::temperature, *s.temperature};
    if (s.heat_flux) wall = {stokes::ThermalWall::Kind::flux, *s.heat_flux};
  }
  return walls;
}

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

}  // namespace

Melt::Melt(std::size_t set, const decomp::Comm& comm, const Scene& scene, const PositionScale& scale)
    : Model(set),
      comm_(&comm),
      scene_(&scene),
      scale_(scale),
      rows_(melt_grid(scene), scale, stokes::even_boxes(melt_grid(scene), comm.size())) {}

Melt::Work::Work(const decomp::Comm& comm, const Scene& scene, const std::vector<decomp::Box>& boxes)
    : solver(comm, melt_grid(scene), boxes),
      transport(comm, melt_grid(scene), boxes),
      flow(solver.make_flow()),
      temperature(patch().size, 0.0),
      composition(patch().size, 0.0),
      share(patch().size, 1.0) {
  if (scene.domain.melt.diffusivity > 0)
    conduction.emplace(comm, melt_grid(scene), boxes, scene.domain.melt.diffusivity, walls_of(scene));
}

FieldSet Melt::fields(const Scene& scene) {
  FieldSet f{Field::id,    Field::position,      Field::velocity,  Field::mass,
             Field::group, Field::flow_pressure, Field::melt_share};
  if (scene.domain.melt.diffusivity > 0) f |= FieldSet{Field::temperature};
  if (scene.groups.size() > 1) f |= FieldSet{Field::composition};
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
    return Stage{
        std::move(name), decomp::Region::update, {}, writes, [work](StepState& s, Side) { work(s); }};
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
  return std::isfinite(state.global.dt);
}

double Melt::longest_step(const Reduction& reduction) const {
  return std::min(scene_->time.dt.value_or(any_step), scene_->domain.melt.courant / reduction[courant_rate_]);
}

void Melt::load(const Particles& cells) {
  if (!work_) work_ = std::make_unique<Work>(*comm_, *scene_, rows_.boxes());
  rows_.find(cells, work_->patch());
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene_->dim); ++a)
    rows_.load(cells, Field::velocity, work_->flow.u[a], a);
  rows_.load(cells, Field::flow_pressure, work_->flow.p);
  rows_.load(cells, Field::melt_share, work_->share);
  if (cells.has(Field::temperature)) rows_.load(cells, Field::temperature, work_->temperature);
  if (cells.has(Field::composition)) rows_.load(cells, Field::composition, work_->composition);
}

stokes::Field Melt::densities() const {
  const MeltControl& m = scene_->domain.melt;
  const double first = scene_->groups.front().density, more = scene_->groups.back().density - first;
  stokes::Field rho(work_->patch().size, 0.0);
  for_cells(work_->patch(), [&](std::size_t k) {
    const double warmer = work_->conduction ? work_->temperature[k] - m.reference_temperature : 0.0;
    rho[k] = (first + more * work_->composition[k]) * (1 - m.expansion * warmer);
  });
  return rho;
}

stokes::Field Melt::viscosities() const {
  const MeltControl& m = scene_->domain.melt;
  const double first = scene_->groups.front().viscosity;
  const double more = exact_log(scene_->groups.back().viscosity / first);
  stokes::Field eta(work_->patch().size, first);
  for_cells(work_->patch(), [&](std::size_t k) {
    const double warmer = work_->conduction ? work_->temperature[k] - m.reference_temperature : 0.0;
    const double c = std::clamp(work_->composition[k], 0.0, 1.0);
    eta[k] = first * exact_exp(more * c - m.viscosity_fall * warmer);
  });
  return eta;
}

// What holds layers at rest is a gradient: without it the tolerance is a share of what makes melts flow.
void Melt::take_off_layers(std::size_t axis, stokes::Field& force) const {
  const stokes::Patch& p = work_->patch();
  std::vector<decomp::ExactSum> sums(static_cast<std::size_t>(p.grid.cells[axis]));
  const auto for_layers = [&](auto work) {
    stokes::for_lines(p, [&](std::ptrdiff_t first, std::int64_t n, std::int64_t y, std::int64_t z) {
      for (std::int64_t i = 0; i < n; ++i) {
        const decomp::Int3 x{p.own.lo[0] + i, y, z};
        work(static_cast<std::size_t>(x[axis]), force[static_cast<std::size_t>(first + i)]);
      }
    });
  };
  for_layers([&](std::size_t layer, double& f) { sums[layer].add(f); });
  decomp::ExactSum::all_reduce(*comm_, sums);
  const double faces = cells_of(p.grid) / static_cast<double>(p.grid.cells[axis]);
  std::vector<double> means;
  for (const decomp::ExactSum& s : sums) means.push_back(s.value() / faces);
  for_layers([&](std::size_t layer, double& f) { f -= means[layer]; });
}

stokes::Velocity Melt::driving_force(const stokes::Field& rho) {
  const stokes::Patch& p = work_->patch();
  stokes::Velocity force = work_->solver.make_flow().u;
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene_->dim); ++a) {
    const double g = 0.5 * scene_->domain.gravity[a];
    if (g == 0) continue;
    const auto below = static_cast<std::size_t>(p.stride[a]);
    for_cells(p, [&](std::size_t k) { force[a][k] = g * (rho[k] + rho[k - below]); });
    take_off_layers(a, force[a]);
  }
  return force;
}

// Where light lies on heavy, what rises in a step is pulled back at its end: with the force of its beginning alone the
// interface would slosh, from dt = 16 pi eta / (drho g wavelength) on ever higher. Of composition alone, which nothing
// evens out: where heat is conducted a flow may stand still in a stratification that it pays for.
stokes::Resistance Melt::stratification(double dt) {
  stokes::Resistance out;
  const stokes::Patch& p = work_->patch();
  const double more = scene_->groups.back().density - scene_->groups.front().density;
  if (more == 0) return out;
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene_->dim); ++a) {
    const double g = scene_->domain.gravity[a];
    if (g == 0) continue;
    out.along[a] = true;
    out.faces[a].assign(p.size, 0.0);
    const auto below = static_cast<std::size_t>(p.stride[a]);
    const double scale = dt * g * more / p.grid.edge[a];
    for_cells(p, [&](std::size_t k) {
      out.faces[a][k] = std::max(0.0, scale * (work_->composition[k] - work_->composition[k - below]));
    });
  }
  return out;
}

void Melt::flow(StepState& state) {
  const MeltControl& m = scene_->domain.melt;
  load(state.particles);
  const stokes::Patch& p = work_->patch();
  work_->solver.refresh(work_->composition);
  stokes::Field rho = densities();
  work_->solver.refresh(rho);
  const double before = std::isfinite(state.global.dt) ? state.global.dt : 0.0;
  work_->solver.set_viscosity(viscosities(), stratification(before));
  // What the tolerance left in cells flows out of them in the next step.
  stokes::Field source(p.size, 0.0);
  if (before > 0) for_cells(p, [&](std::size_t k) { source[k] = (work_->share[k] - 1) / before; });
  double g2 = 0;
  for (const double g : scene_->domain.gravity) g2 += g * g;
  const double weight = scene_->groups.front().density * std::sqrt(g2 * cells_of(p.grid));
  effort_ = work_->solver.solve(driving_force(rho), work_->flow, m.tolerance,
                                static_cast<int>(m.most_iterations), &source, least_force * weight);
  if (!effort_.converged)
    throw GuardError(fmt::format(
        "{}the slow flow has a residual of {:.3g} after {} iterations, wanted {}: viscosities may "
        "differ too sharply, raise melt.most_iterations or melt.tolerance",
        step_text(state.global.step), effort_.residual, effort_.iterations, m.tolerance));
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene_->dim); ++a)
    rows_.store(work_->flow.u[a], Field::velocity, state.particles, a);
  rows_.store(work_->flow.p, Field::flow_pressure, state.particles);
  courant_step_ = std::min(work_->transport.longest_step(work_->flow.u, m.courant), conduction_step(*scene_));
  state.global.dt = std::min(state.global.dt, courant_step_);
  if (!std::isfinite(state.global.dt) || !(state.global.dt > 0))
    throw GuardError(step_text(state.global.step) +
                     (state.global.dt > 0 ? "nothing flows, and there is no time.dt: give one"
                                          : "the slow flow is not finite: check densities and viscosities"));
}

// Half of the conduction, what the flow carries, the other half (Strang 1968): steady states keep the second order.
void Melt::carry(StepState& state) {
  const double dt = state.global.dt;
  const bool two = state.particles.has(Field::composition);
  std::vector<stokes::Field*> carried;
  if (work_->conduction) carried.push_back(&work_->temperature);
  if (two) carried.push_back(&work_->composition);
  const auto conduct = [&] {
    if (!work_->conduction) return;
    const double theta = implicitness(work_->patch().grid, scene_->domain.melt.diffusivity, 0.5 * dt);
    (void)work_->conduction->advance(0.5 * dt, work_->temperature, theta);
  };
  conduct();
  work_->transport.advect(work_->flow.u, dt, work_->share, carried);
  conduct();
  if (work_->conduction) rows_.store(work_->temperature, Field::temperature, state.particles);
  if (two) rows_.store(work_->composition, Field::composition, state.particles);
  rows_.store(work_->share, Field::melt_share, state.particles);
}

std::vector<std::string> Melt::columns() const {
  std::vector<std::string> out{"iterations", "residual", "v_rms"};
  if (scene_->domain.melt.diffusivity > 0) out.emplace_back("temperature");
  if (scene_->groups.size() > 1) out.emplace_back("composition");
  for (const MeltSide& s : scene_->domain.melt.sides)
    if (s.temperature || s.heat_flux)
      out.push_back(std::string("heat_") + side_names[static_cast<std::size_t>(s.side)]);
  return out;
}

std::vector<double> Melt::values(const Particles& cells) {
  load(cells);
  const stokes::Patch& p = work_->patch();
  std::array<decomp::ExactSum, 3> sums;
  for_cells(p, [&](std::size_t k) {
    double square = 0;
    for (std::size_t a = 0; a < static_cast<std::size_t>(scene_->dim); ++a)
      square += work_->flow.u[a][k] * work_->flow.u[a][k];
    sums[0].add(square);
    sums[1].add(work_->temperature[k]);
    sums[2].add(work_->composition[k] * work_->share[k]);
  });
  decomp::ExactSum::all_reduce(*comm_, sums);
  const double n = cells_of(p.grid);
  std::vector<double> out{static_cast<double>(effort_.iterations), effort_.residual,
                          std::sqrt(sums[0].value() / n)};
  if (work_->conduction) out.push_back(sums[1].value() / n);
  if (scene_->groups.size() > 1) out.push_back(sums[2].value() / n);
  for (const MeltSide& s : scene_->domain.melt.sides)
    if (s.temperature || s.heat_flux)
      out.push_back(work_->conduction->mean_inflow(work_->temperature, static_cast<int>(s.side) / 2,
                                                   static_cast<int>(s.side) % 2));
  return out;
}

}  // namespace sph
