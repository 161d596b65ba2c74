#include "sph/models/melt_work.hpp"

#include <algorithm>
#include <cmath>

#include "decomp/exact_sum.hpp"
#include "sph/core/exact_math.hpp"
#include "sph/scene/melt_grid.hpp"

namespace sph {
namespace {

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

}  // namespace

MeltWork::MeltWork(const decomp::Comm& comm, const Scene& scene, const std::vector<decomp::Box>& boxes)
    : comm_(&comm),
      scene_(&scene),
      melts_(melts_of(scene)),
      solver(comm, melt_grid(scene), boxes),
      transport(comm, melt_grid(scene), boxes),
      flow(solver.make_flow()),
      temperature(patch().size, 0.0),
      composition(patch().size, 0.0),
      share(patch().size, 1.0) {
  if (scene.domain.melt.diffusivity > 0)
    conduction.emplace(comm, melt_grid(scene), boxes, scene.domain.melt.diffusivity, walls_of(scene));
  if (scene.has_grains()) suspended.emplace();
}

stokes::Field MeltWork::densities() const {
  const MeltControl& m = scene_->domain.melt;
  const double first = scene_->groups[melts_[0]].density, more = scene_->groups[melts_[1]].density - first;
  stokes::Field rho(patch().size, 0.0);
  stokes::for_own(patch(), [&](std::size_t k) {
    const double warmer = conduction ? temperature[k] - m.reference_temperature : 0.0;
    rho[k] = (first + more * composition[k]) * (1 - m.expansion * warmer);
  });
  return rho;
}

stokes::Field MeltWork::viscosities() const {
  const MeltControl& m = scene_->domain.melt;
  const double first = scene_->groups[melts_[0]].viscosity;
  const double more = exact_log(scene_->groups[melts_[1]].viscosity / first);
  stokes::Field eta(patch().size, first);
  stokes::for_own(patch(), [&](std::size_t k) {
    const double warmer = conduction ? temperature[k] - m.reference_temperature : 0.0;
    const double c = std::clamp(composition[k], 0.0, 1.0);
    eta[k] = first * exact_exp(more * c - m.viscosity_fall * warmer);
  });
  return eta;
}

// Hydrodynamic alone (Boyer, Guazzelli & Pouliquen 2011): contacts resist by themselves. What their springs will have
// taken up at the end of the flow's interval counts as a viscosity, or steps were bound to what a spring relaxes in.
void MeltWork::thicken(stokes::Field& eta, double dt) const {
  constexpr double einstein = 2.5, least_room = 0.05;
  const double packed = scene_->grains.drag.packed_fraction;
  stokes::for_own(patch(), [&](std::size_t k) {
    const double phi = suspended->solid[k];
    eta[k] =
        eta[k] * (1 + einstein * phi / std::max(1 - phi / packed, least_room)) + dt * suspended->stiffness[k];
  });
}

// What holds layers at rest is a gradient: without it the tolerance is a share of what makes melts flow.
void MeltWork::take_off_layers(std::size_t axis, stokes::Field& force) const {
  const stokes::Patch& p = patch();
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
  const double faces = static_cast<double>(p.grid.cells[0] * p.grid.cells[1] * p.grid.cells[2]) /
                       static_cast<double>(p.grid.cells[axis]);
  std::vector<double> means;
  for (const decomp::ExactSum& s : sums) means.push_back(s.value() / faces);
  // Along a period the mean of all is no gradient: it drives a flow, where some wall holds that.
  if (p.grid.periodic(static_cast<int>(axis)) && !p.grid.slides(static_cast<int>(axis))) {
    decomp::ExactSum all;
    for (const decomp::ExactSum& s : sums) all.add(s);
    const double mean = all.value() / (faces * static_cast<double>(p.grid.cells[axis]));
    for (double& of_layer : means) of_layer -= mean;
  }
  for_layers([&](std::size_t layer, double& f) { f -= means[layer]; });
}

stokes::Velocity MeltWork::driving_force(const stokes::Field& rho) const {
  const stokes::Patch& p = patch();
  stokes::Velocity force = solver.make_flow().u;
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene_->dim); ++a) {
    const double g = 0.5 * scene_->domain.gravity[a];
    if (g == 0) continue;
    const auto below = static_cast<std::size_t>(p.stride[a]);
    stokes::for_own(p, [&](std::size_t k) { force[a][k] = g * (rho[k] + rho[k - below]); });
    take_off_layers(a, force[a]);
  }
  for (std::size_t a = 0; suspended && a < static_cast<std::size_t>(scene_->dim); ++a)
    stokes::for_own(p, [&](std::size_t k) { force[a][k] += suspended->force[a][k]; });
  return force;
}

// Where light lies on heavy, what rises in a step is pulled back at its end: with the force of its beginning alone the
// interface would slosh, from dt = 16 pi eta / (drho g wavelength) on ever higher. Of composition alone, which nothing
// evens out: where heat is conducted a flow may stand still in a stratification that it pays for.
stokes::Resistance MeltWork::stratification(double dt) const {
  stokes::Resistance out;
  const stokes::Patch& p = patch();
  const double more = scene_->groups[melts_[1]].density - scene_->groups[melts_[0]].density;
  if (more == 0 && !suspended) return out;
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene_->dim); ++a) {
    const double g = scene_->domain.gravity[a];
    if (g == 0) continue;
    out.along[a] = true;
    out.faces[a].assign(p.size, 0.0);
    const auto below = static_cast<std::size_t>(p.stride[a]);
    const double scale = dt * g * more / p.grid.edge[a], of_grains = dt * g / p.grid.edge[a];
    stokes::for_own(p, [&](std::size_t k) {
      double back = scale * (composition[k] - composition[k - below]);
      if (suspended) back += of_grains * (suspended->excess[k] - suspended->excess[k - below]);
      out.faces[a][k] = std::max(0.0, back);
    });
  }
  return out;
}

}  // namespace sph
