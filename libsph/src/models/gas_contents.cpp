#include "models/gas_contents.hpp"

#include <fmt/format.h>

#include "sph/laws/eos/bubbly.hpp"

namespace sph {

void GasContents::start(const SphConstants& constants, Particles& p) {
  const Scene& scene = *constants.scene;
  const auto* group = p.data<Field::group>();
  const double *mass = p.data<Field::mass>(), *m = p.data<Field::gas_content>();
  double* liquid = p.data<Field::liquid_mass>();
  for (std::size_t i = 0; i < p.owned(); ++i)
    liquid[i] = scene.groups[group[i]].eos.law->kind == EosKind::bubbly ? mass[i] / (1 + m[i]) : 0.0;
}

bool GasContents::is_fault(const SphConstants& constants, const FaultView& p, std::size_t i, double content,
                           const Step& step) {
  const bool possible = content >= 0 && content < 1;
  if (possible && can_hold(constants.scene->groups[p.get<Field::group>()[i]], content)) return false;
  find_fault(constants, p, i, step,
             fmt::format("has a gas content of {:.3g}{}", content,
                         possible      ? ", of which the densest gas is denser than the liquid; check the "
                                         "solubility, or lower the gas_pressure of walls"
                         : content < 0 ? "; reduce time.dt, time.cfl or group.permeability"
                                       : ": more gas than liquid, which bubbly magma does not have; lower "
                                         "the gas_pressure of walls, or the void fraction of the foam beside "
                                         "them"));
  return true;
}

void GasContents::take_in(const Rows& p, std::size_t i, double dt, double more, double heat) {
  const auto d = static_cast<std::size_t>(p.dim());
  double &m = p.get<Field::gas_content>()[i], &mass = p.get<Field::mass>()[i];
  m += more;
  const double now = p.get<Field::liquid_mass>()[i] * (1 + m);
  if (double* h = p.get<Field::enthalpy>())
    h[i] = (mass * h[i] + dt * p.get<Field::gas_heat>()[i] + heat) / now;
  p.get<Field::density>()[i] *= now / mass;
  mass = now;
  const double* momentum = p.get<Field::gas_gain>() + i * (d + 1) + 1;
  for (std::size_t a = 0; a < d; ++a) p.get<Field::velocity>()[i * d + a] += dt * momentum[a] / now;
}

}  // namespace sph
