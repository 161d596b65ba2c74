// Grains without inertia in the slow flow of melts (reference: Furuichi & Nishiura 2014; the mean field of Anderson & Jackson
// 1967 with Stokes's drag). U is the velocity of both, div U = 0, and of a grain in it, with the kernel K of the grid,
//   v = U + w - q,   w = (F - V f) / zeta - a F,   F = V (rho_s - rho_f) g + F_c,   f = sum F K,   q = sum V w K,
//   omega = curl U / 2 + T_c / (pi eta d^3),
// F_c, T_c of its contacts, zeta of the drag law (laws/drag/law.hpp) at rest. f is also the force on the mixture, beside the
// weight of the melt, so that in a bed at rest, where F = 0, nothing flows. a = S m0 / (eta* h): a grain must not ride on
// its own force, smeared over the grid; of f and of the volume that others take up its own part is taken off too, as far
// as S, which grains around it leave of that. A flow serves until its interval is over; until then the free part of v,
//   v = v_free + (1 / zeta - a) F_c,
// stays, and contacts move the grains in as many steps as their stiffness wants.
#pragma once

#include <vector>

#include "sph/models/grain_grid.hpp"
#include "sph/models/grains.hpp"
#include "sph/models/melt.hpp"
#include "sph/models/model.hpp"
#include "sph/pairs/set_pair.hpp"

namespace sph {

class Suspension final : public Model, public SetPair {
 public:
  /// Of grains; free_spin where they spin.
  [[nodiscard]] static FieldSet fields(const Scene& scene);

  Suspension(std::size_t grains, std::size_t cells, const decomp::Comm& comm, const Scene& scene,
             const PositionScale& scale, const Grains& contacts, Melt& melt);

  /// With the stages of the melt's own plan between its own.
  [[nodiscard]] Plan plan();

  // As a model.
  [[nodiscard]] double start(const decomp::Comm&, Particles& grains, GlobalState&) override;
  [[nodiscard]] bool report(const StepState&, Reduction&) override { return true; }
  void act(const Reduction&, GlobalState& global) override;
  [[nodiscard]] double longest_step(const Reduction&) const override { return next_step_; }

  // As a pair of sets.
  [[nodiscard]] std::size_t set() const { return Model::set(); }
  [[nodiscard]] FieldSet constants() const override { return {}; }
  void rebuild(const Particles& grains, const ListSetting& setting, decomp::Payload&,
               std::span<const std::uint32_t>) override;
  void count(const RowRanges&, std::span<std::uint32_t>) const override {}

 private:
  /// Of a grain where the flow is found.
  struct Around {
    GridKernel kernel;
    double volume;
    double excess = 0;  ///< rho_s - rho_f [kg/m^3]
    Double3 weight{};   ///< V (rho_s - rho_f) g [N]
  };
  /// What of the flow a grain sees.
  struct Seen {
    Double3 velocity, curl;
    Double3 slip;  ///< w without what F_c makes of it [m/s]
    double mobility, spin_mobility;
  };
  [[nodiscard]] Around around(const Particles& grains, std::size_t i) const;
  [[nodiscard]] Seen look(const Particles& grains, std::size_t i, const Around& at) const;

  [[nodiscard]] double unit_of(const GlobalState& global, double largest) const;
  void weigh(const GlobalState& global, const Particles& grains);
  void spread(const StepState& s);
  void see_flow(StepState& s);
  void share_interval(const StepState& s);
  void spread_ways(const StepState& s);

  const decomp::Comm* comm_;
  const Scene* scene_;
  PositionScale scale_;
  const Grains* contacts_;
  Melt* melt_;
  stokes::Grid cells_;
  GrainGrid grid_;
  struct Units {
    double force, stiffness;
  } unit_{};  ///< of what grains put down
  struct Sizes {
    double cell;          ///< width [m]
    double least_radius;  ///< of all grains [m]
    double to_come;       ///< stiffness that a grain may meet before the next flow [N/m]
  } size_{};
  double next_step_ = any_step;
  struct Fields {
    stokes::Velocity velocity, force, slip;
    stokes::Field solid, viscosity, density, melt_viscosity;
  } seen_;  ///< where grains look
  struct Rows {
    std::vector<double> excess;                          ///< rho_s - rho_f [kg/m^3]
    std::vector<std::array<std::int64_t, 2>> stiffness;  ///< of contacts, normal and tangential [its unit]
  } of_;                                                 ///< each grain
};

}  // namespace sph
