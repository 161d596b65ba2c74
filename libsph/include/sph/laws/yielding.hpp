// Strength of updated-Lagrangian solids: after the elastic change of a step the stress is brought back onto the yield
// surface (laws/mohr_coulomb.hpp, laws/drucker_prager.hpp), that of the stress above the surface pressure. In the
// plane the third axis is that of plane strain, s_zz = -(s_xx + s_yy). The pressure moves by the plastic volume e,
// p = K (rho (1 + e)/rho_0 - 1). Work is that of the stress on the surface on the plastic strain, never negative: what the
// return takes of the trial's elastic energy is more than forces, which never see the trial, have spent.
// What tension has opened (`opening`, part of e) closes again where all stresses press on it, until one is 0: debris that
// has flown apart is as dense as before when it lies. What dilatancy has opened stays.
// Softening (crack band: Bazant & Oh 1983): c falls linearly from c_0 to c_r over the plastic shear
// 2 G_f / ((c_0 - c_r) cos(phi) dx), and the tensile strength with it, so that a band one spacing wide takes G_f of
// cohesion per area at any spacing.
#pragma once

#include <limits>

#include "sph/laws/plasticity.hpp"
#include "sph/scene/group_scene.hpp"

namespace sph {

/// A group's strength, ready for use.
class Yielding {
 public:
  /// Of a group that has one; `spacing` of the start [m].
  Yielding(const Group& group, int dim, double spacing);

  [[nodiscard]] StrengthConstants constants(double plastic_shear) const;
  /// Plastic shear at which cohesion is residual; infinite without fracture_energy.
  [[nodiscard]] double softening_shear() const { return softening_shear_; }

  /// To which openings let the pressure fall as they close; p itself where something pulls [Pa].
  [[nodiscard]] double closed_pressure(const double* s, double p) const;

  struct End {
    bool yields = false;
    double pressure = 0;  ///< [Pa]
    double plastic_shear = 0;
    double opening_share = 0;  ///< of what is added to the plastic volume: by tension
    double shear_work = 0;     ///< of the new deviator on the plastic strain [J/m^3]
  };
  /// Of a deviator s, xx yy (zz) xy (xz yz), which it changes, and a pressure p [Pa].
  [[nodiscard]] End bring_back(double* s, double p, double plastic_shear) const;

 private:
  StrengthLaw law_;
  StrengthConstants at_start_;
  double residual_share_ = 1, softening_shear_ = std::numeric_limits<double>::infinity();
};

}  // namespace sph
