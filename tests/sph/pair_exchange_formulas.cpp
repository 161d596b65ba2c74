// The formulas of exchanges of heat and gas.
#include <algorithm>
#include <cmath>

#include "pair_oracle.hpp"

namespace sph::test {
namespace {

/// Into a particle at T, whose way to the face conducts so much: the face is as warm as makes both fluxes the same.
struct FaceFlux {
  double given, slope;
};
FaceFlux face_flux(const GroupHeat& wall, double t, double conducts) {
  if (wall.wall_flux) return {*wall.wall_flux, 0};
  const auto from_wall = [&](double face) {
    return wall.transfer.coefficient * (wall.transfer.temperature - face) +
           wall.radiation.emissivity * 5.670374419e-8 *
               (power(wall.radiation.temperature, 4) - power(face, 4));
  };
  double cold = 0, warm = 1e5;
  for (int k = 0; k < 200; ++k) {
    const double face = 0.5 * (cold + warm);
    (from_wall(face) > conducts * (face - t) ? cold : warm) = face;
  }
  const double takes =
      wall.transfer.coefficient + 4 * wall.radiation.emissivity * 5.670374419e-8 * power(cold, 3);
  return {from_wall(cold), takes > 0 ? 1 / (1 / takes + 1 / conducts) : 0.0};
}

}  // namespace

// Cleary & Monaghan (1999), eq. 29; Darcy's law, Fick's law; beside walls what is straight between the particle and the face.
void PairOracle::add_exchange(const Pair& pair, Term term, PairSums& sums) const {
  const PairParticle &i = pair.i, &j = pair.j;
  const auto one = [&](Field f, int k, double value) {
    sums.of[static_cast<std::size_t>(f)][static_cast<std::size_t>(k)].add(value);
  };
  const double weight = -2 * i.volume * j.volume * pair.slope / pair.r / second_;
  double head = 0;
  for (int a = 0; a < dim_; ++a) head += scene_.domain.gravity[static_cast<std::size_t>(a)] * pair.x(a);
  const double across = -i.slope.dot(pair.x) / h_, steepness = i.slope.norm();
  const double profile = steepness > 0 ? std::max(across, 0.0) : 1.0;
  if (term.name == "Conduction" || term.name == "ConductionOperator") {
    if (!j.mover) return;
    const double rate = weight * harmonic(i.conductivity, j.conductivity);
    if (term.name == "Conduction") return one(Field::heat_gain, 0, rate * (j.temperature - i.temperature));
    one(Field::exchange_sums, 0, rate * (j.trial - i.trial));
    one(Field::exchange_sums, 1, rate);
  } else if (term.name == "WallConduction" || term.name == "WallTransferConduction") {
    if (j.mover) return;
    if (j.warm) {
      one(Field::wall_heat, 0, weight * i.conductivity * profile * (j.temperature - i.temperature));
      one(Field::wall_heat, 1, weight * i.conductivity * profile);
    }
    const double way = steepness > 0 ? across / steepness * h_ : pair.r;
    const double area = -2 * i.volume * j.volume * pair.slope / pair.r * way;
    const FaceFlux flux = face_flux(scene_.groups[static_cast<std::size_t>(j.group)].heat, i.temperature,
                                    i.conductivity * (steepness > 0 ? steepness / h_ : 1 / pair.r));
    one(Field::wall_heat, 0, area * flux.given);
    one(Field::wall_heat, 1, area * flux.slope);
  } else if (term.name == "GasSlope") {
    if (!j.mover && !j.open) return;
    const double weight_j = j.volume * pair.slope / pair.r;
    for (int a = 0; a < dim_; ++a)
      one(Field::gas_slope, a,
          weight_j * (j.gas_pressure - i.gas_pressure - i.gas_density * head) * pair.x(a));
    one(Field::gas_slope, dim_, weight_j * pair.x.squaredNorm() / h_);
  } else if (term.name.ends_with("GasFlow") || term.name.ends_with("GasHeat") || term.name == "GasOperator") {
    if (!j.mover) return;
    const double lift = 0.5 * (i.gas_density + j.gas_density) * head;
    const double before = j.gas_pressure - i.gas_pressure - lift;
    const double drive = term.name.starts_with("Implicit") ? j.trial - i.trial - lift : before;
    const auto upstream = [&](double by) { return by > 0 ? j.gas_mobility : i.gas_mobility; };
    const double up = std::min(upstream(before), upstream(term.name == "GasOperator" ? before : drive));
    const double rate = weight * harmonic(i.permeability, j.permeability) *
                        std::min(0.5 * (i.gas_mobility + j.gas_mobility), 2 * up);
    if (term.name == "GasOperator") {
      one(Field::exchange_sums, 0, rate * (j.trial - i.trial));
      return one(Field::exchange_sums, 1, rate);
    }
    const double flow = rate * drive;
    if (term.name.ends_with("GasHeat"))
      return one(Field::gas_heat, 0, flow * (drive > 0 ? j : i).sensible_heat);
    one(Field::gas_gain, 0, flow);
    for (int a = 0; a < dim_; ++a) one(Field::gas_gain, 1 + a, 0.5 * flow * (j.v(a) - i.v(a)));
  } else if (term.name == "WaterDiffusion" || term.name == "WaterHeat") {
    const double flow = weight * harmonic(i.water_mobility, j.water_mobility) * (j.dissolved - i.dissolved);
    if (term.name == "WaterHeat") return one(Field::gas_heat, 0, flow * (flow > 0 ? j : i).sensible_heat);
    one(Field::gas_gain, 0, flow);
    for (int a = 0; a < dim_; ++a) one(Field::gas_gain, 1 + a, 0.5 * flow * (j.v(a) - i.v(a)));
  } else if (term.name == "ViscousHeat" || term.name == "SymmetricViscousHeat") {
    if (!j.mover && j.slips) return;
    const Vec dv = j.v - i.v;
    const double eta = j.mover ? 0.5 * harmonic(i.viscosity, j.viscosity) : i.viscosity * profile;
    one(Field::viscous_heat, 0,
        term.name == "ViscousHeat"
            ? weight * eta * dv.squaredNorm()
            : weight * second_ * eta * (dim_ + 2) / fourth_ * power(dv.dot(pair.x), 2));
  } else if (j.open) {
    const double drive = j.gas_pressure - i.gas_pressure - i.gas_density * head;
    one(Field::wall_gas, 0, weight * i.permeability * i.gas_mobility * profile * drive);
    one(Field::wall_gas, 1, weight * i.permeability * i.gas_mobility * profile);
  }
}

}  // namespace sph::test
