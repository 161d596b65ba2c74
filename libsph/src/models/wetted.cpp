// Total-Lagrangian solids in a fluid (terms/wetted.hpp): what they have of the fluid beside them, and the sum of its
// forces and those of their bonds. A body's acceleration, in whose frame pressures are extrapolated, is that of
// the step before, a mean over h / c of the fluid: what changes faster is sound, and a body much lighter than the fluid
// in a kernel's reach would answer to its own answer.
#include "sph/terms/wetted.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "pairs/for_rows.hpp"
#include "sph/models/models.hpp"
#include "sph/models/wall_pressures.hpp"
#include "sph/terms/crack.hpp"

namespace sph {
namespace {

struct WetSides {
  static constexpr FieldSet reads = WallPressures::reads;
  static constexpr FieldSet writes =
      WallPressures::writes | FieldSet{Field::wet_pressure, Field::wet_velocity};
  const Scene* scene;
  WallPressures walls;
  std::vector<int> rigid_body_of;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    walls(p, step);
    const auto d = static_cast<std::size_t>(p.dim());
    const double *sums = p.get<Field::wall_sums>(), *v = p.get<Field::velocity>();
    double *pressure = p.get<Field::wet_pressure>(), *velocity = p.get<Field::wet_velocity>();
    double* own = p.get<Field::pressure>();
    const auto* group = p.get<Field::group>();
    for_walls(step.ranges, [&](std::size_t i) { pressure[i] = 0; });
    for_movers(step.ranges, [&](std::size_t i) {
      const double* s = sums + i * (2 + 2 * d);
      const bool wet = s[0] > 0 && is_body(scene->groups[group[i]]);
      pressure[i] = wet ? s[1] / s[0] : 0.0;
      if (is_rigid(scene->groups[group[i]])) own[i] = pressure[i];
      if (!wet) return void(std::copy_n(v + i * d, d, velocity + i * d));
      const Double3 there = velocity_beside(s, d, rigid_body_of[group[i]], step.global);
      for (std::size_t a = 0; a < d; ++a) velocity[i * d + a] = 2 * v[i * d + a] + there[a] - s[2 + a] / s[0];
    });
  }

  // What the fluid has in the frame of the body is mirrored. Beside one that spins the body's own velocity is another
  // where the fluid is: omega x <x_f - x_b> of it.
  [[nodiscard]] Double3 velocity_beside(const double* s, std::size_t d, int body,
                                        const GlobalState& global) const {
    if (body < 0) return {};
    const std::array<double, 3>& w = global.bodies[static_cast<std::size_t>(body)].motion.spin;
    Double3 way{};
    for (std::size_t a = 0; a < d; ++a) way[a] = scene->kernel.smoothing_length * s[2 + d + a] / s[0];
    return {w[1] * way[2] - w[2] * way[1], w[2] * way[0] - w[0] * way[2], w[0] * way[1] - w[1] * way[0]};
  }
};

/// In the units of the sums, with volumes in spacings.
struct Fluxes {
  static constexpr FieldSet reads{Field::flux_sums, Field::mass, Field::density, Field::group};
  static constexpr FieldSet writes{Field::flux};
  const Scene* scene;
  double inverse_volume;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const double *sums = p.get<Field::flux_sums>(), *mass = p.get<Field::mass>(),
                 *rho = p.get<Field::density>();
    const auto* group = p.get<Field::group>();
    const auto update = [&](std::size_t i) {
      const double* s = sums + 2 * i;
      const bool wet = s[0] > 0 && scene->groups[group[i]].kind != GroupKind::fluid;
      p.get<Field::flux>()[i] = wet ? mass[i] / rho[i] * inverse_volume * s[1] / s[0] : 0.0;
    };
    for_walls(step.ranges, update);
    for_movers(step.ranges, update);
  }
};

struct BondForces {
  static constexpr FieldSet reads =
      BodyForces::reads | FieldSet{Field::bond_force, Field::mass, Field::group};
  static constexpr FieldSet writes{Field::force, Field::acceleration};
  const Scene* scene;
  const BodyForces* body_forces;
  double rate;  ///< c / h of the fluid [1/s]

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const auto d = static_cast<std::size_t>(p.dim());
    const double *bonds = p.get<Field::bond_force>(), *mass = p.get<Field::mass>();
    double *force = p.get<Field::force>(), *mean = p.get<Field::acceleration>();
    const auto* group = p.get<Field::group>();
    const double share = std::fmin(rate * step.global.dt, 1.0);
    for_movers(step.ranges, [&](std::size_t i) {
      const Group& g = scene->groups[group[i]];
      if (!is_body(g)) return;
      for (std::size_t a = 0; bonds != nullptr && a < d; ++a) force[i * d + a] += bonds[i * d + a];
      if (is_rigid(g)) return;  // accelerated by the sum of all its forces (models/rigid_bodies.cpp)
      const Double3 body = (*body_forces)(p, i, step);
      for (std::size_t a = 0; a < d; ++a) {
        const double f = force[i * d + a];
        mean[i * d + a] += share * (f / mass[i] + body[a] - mean[i * d + a]);
      }
    });
  }
};

}  // namespace

void add_flow_onto_solids(Builder& b) {
  b.add_fields({Field::flux});
  b.add_sums("flow onto solids",
             {has_failure(b.scene()) ? term<CrackedFlowOntoSolids> : term<FlowOntoSolids>},
             Builder::Rows::all);
  b.add_update("fluxes", Fluxes{&b.scene(), b.constants().row_scale.inverse_volume});
}

void add_wet_sides(Builder& b) {
  b.add_fields({Field::wet_pressure, Field::wet_velocity});
  b.add_sums("sides", {term<WettedExtrapolation>}, Builder::Rows::all);
  b.add_update("pressures of sides", WetSides{&b.scene(), wall_pressures(b), rigid_bodies_of(b.scene())});
}

void add_bond_forces(Builder& b) {
  const Scene& s = b.scene();
  double sound = 0;
  for (std::size_t g = 0; g < s.groups.size(); ++g)
    if (s.groups[g].kind == GroupKind::fluid) sound = std::fmax(sound, b.constants().groups.sound_speed[g]);
  b.add_update("forces of bodies", BondForces{&s, &b.body_forces(), sound / s.kernel.smoothing_length});
}

}  // namespace sph
