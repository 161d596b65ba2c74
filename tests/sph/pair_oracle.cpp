#include "pair_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sph/core/kernels.hpp"

namespace sph::test {
namespace {

using std::numbers::pi;

}  // namespace

PairOracle::PairOracle(const PairCase& of)
    : of_(of),
      scene_(of.scene()),
      dim_(scene_.dim),
      h_(scene_.kernel.smoothing_length),
      unit_(Mat::Identity()) {
  if (dim_ == 2) unit_(2, 2) = 0;
  second_ = moment(1);
  fourth_ = moment(3);
  looks_back_ = std::ranges::any_of(of.fusion().terms, [](Term t) {
    return t.name == "Divergence" || t.name == "WeightedDivergence" || t.name == "VelocityGradient" ||
           t.name == "SlippingGradient" || t.name == "FlowOntoSolids" || t.name == "CrackedFlowOntoSolids";
  });
  load();
}

void PairOracle::load() {
  const Particles& p = of_.particles();
  const auto d = static_cast<std::size_t>(dim_);
  const FieldSet read = fields_behind(of_.fusion().values) | FieldSet{Field::group, Field::wall_slope};
  const auto get = [&](Field f, std::size_t row, std::size_t k) {
    if (!read.has(f) || !p.has(f)) return 0.0;
    const auto n = static_cast<std::size_t>(components(info(f).shape, dim_));
    return p.table().as<double>(p.column(f))[row * n + k];
  };
  all_.resize(p.rows());
  for (std::size_t row = 0; row < p.rows(); ++row) {
    PairParticle& q = all_[row];
    for (Vec* v : {&q.v, &q.colour, &q.direction, &q.slope, &q.rest_gradient, &q.wet_v, &q.frame, &q.shift,
                   &q.crack, &q.reaction})
      v->setZero();
    for (Mat* m : {&q.stress, &q.bond_stress, &q.gradient}) m->setZero();
    const std::uint32_t group = p.data<Field::group>()[row];
    const Group& g = scene_.groups[group];
    q.pressure = get(Field::pressure, row, 0);
    for (std::size_t a = 0; a < d; ++a) {
      const auto e = static_cast<Eigen::Index>(a);
      q.x[a] = q.reference[a] = p.data<Field::position>()[row * d + a];
      if (read.has(Field::displacement)) q.reference[a] -= p.data<Field::displacement>()[row * d + a];
      q.v(e) = get(Field::velocity, row, a);
      q.colour(e) = get(Field::colour_gradient, row, a);
      q.direction(e) = get(Field::direction, row, a);
      q.slope(e) = get(Field::wall_slope, row, a);
      q.wet_v(e) = is_body(g) ? get(Field::wet_velocity, row, a) : q.v(e);
      q.crack(e) = get(Field::crack, row, a);
      q.shift(e) = get(Field::clamp_shift, row, a);
      q.reaction(e) = g.kind == GroupKind::wall ? get(Field::clamp_reaction, row, a) : 0.0;
      q.frame(e) = is_body(g) ? get(Field::acceleration, row, a) : 0.0;
      if (g.kind != GroupKind::wall)
        q.rest_gradient(e) =
            get(Field::liquid_density, row, 0) * (scene_.domain.gravity[a] + get(Field::grain_drag, row, a));
      for (std::size_t b = 0; b < d; ++b) {
        const auto f = static_cast<Eigen::Index>(b);
        const int s =
            symmetric_index(static_cast<int>(std::min(a, b)), static_cast<int>(std::max(a, b)), dim_);
        q.stress(e, f) = get(Field::stress, row, static_cast<std::size_t>(s)) - (a == b ? q.pressure : 0.0);
        q.bond_stress(e, f) = get(Field::bond_stress, row, a * d + b);
        q.gradient(e, f) = g.kind == GroupKind::wall ? 0.0 : get(Field::velocity_gradient, row, a * d + b);
      }
    }
    q.wet_pressure = is_body(g) ? get(Field::wet_pressure, row, 0) : q.pressure;
    q.flux = get(Field::flux, row, 0);
    q.mass = get(Field::mass, row, 0);
    q.density = get(Field::density, row, 0);
    q.weight = q.density * (1 - scene_.domain.background.density / g.density);
    q.volume = q.density > 0 ? q.mass / q.density : 0.0;
    q.sound = get(Field::sound_speed, row, 0);
    if (!p.has(Field::sound_speed)) {
      const double shear = g.kind == GroupKind::solid ? g.solid.shear_modulus : 0.0;
      q.sound = std::sqrt((g.eos.bulk_modulus + 4.0 / 3.0 * shear) / g.density);
    }
    q.energy = get(Field::specific_energy, row, 0);
    q.width = get(Field::smoothing_length, row, 0);
    q.correction = get(Field::kernel_correction, row, 0);
    q.curvature = get(Field::curvature, row, 0);
    for (std::size_t k = 0; k < 2; ++k) q.wall_pressures[k] = get(Field::wall_pressures, row, k);
    q.viscosity = p.has(Field::viscosity) ? get(Field::viscosity, row, 0) : g.viscosity;
    q.temperature = get(Field::temperature, row, 0);
    q.trial = get(Field::trial, row, 0);
    q.conductivity = g.heat.material.conductivity;
    q.sensible_heat = g.heat.material.specific_heat * q.temperature;
    q.warm = g.heat.temperature.has_value();
    q.permeability = g.bubbly.permeability.coefficient;
    q.gas_mobility = get(Field::gas_mobility, row, 0);
    q.gas_pressure = get(Field::gas_pressure, row, 0);
    q.gas_density = g.kind == GroupKind::wall ? 0.0 : q.gas_pressure / g.bubbly.gas_rt;
    q.dissolved = std::min(get(Field::dissolved_gas, row, 0), get(Field::gas_content, row, 0));
    q.water_mobility = q.density / (1 + get(Field::gas_content, row, 0)) * g.bubbly.water_diffusivity;
    q.overload = get(Field::overload, row, 0);
    q.crack_distance = get(Field::crack_distance, row, 0);
    q.crack_closing = get(Field::crack_closing, row, 0);
    q.failing = read.has(Field::failing) && p.data<Field::failing>()[row] == 1;
    q.open = g.wall.gas_pressure.has_value();
    q.slips = g.wall.slip;
    q.group = static_cast<int>(group);
    q.body = group == clamp ? static_cast<int>(solid) : q.group;
    const Group& material = scene_.groups[static_cast<std::size_t>(q.body)];
    q.modulus = g.kind == GroupKind::fluid
                    ? 0.0
                    : material.eos.bulk_modulus + 4.0 / 3.0 * material.solid.shear_modulus;
    q.hourglass =
        is_bonded(g) ? 1.75 * g.solid.shear_modulus : 0.0;  // as libsph/src/models/sph_constants.cpp has it
    q.rest_volume = q.mass / g.density;
    q.mover = g.kind != GroupKind::wall;
    q.shears = g.kind != GroupKind::fluid;
    q.heavy = group == heavy;
    q.side = group == light ? 1 : group == heavy ? -1 : 0;
    q.owned = row < p.owned();
  }
}

// Morris et al. (1997), Wendland (1995).
double PairOracle::w(double r, double h) const {
  const double q = r / h, scale = 1 / power(h, dim_), s = std::max(1 - q / 2, 0.0);
  const auto cut = [&](double reach) { return power(std::max(reach - q, 0.0), 5); };
  if (scene_.kernel.shape == KernelShape::wendland_c2)
    return scale * (dim_ == 2 ? 7 / (4 * pi) : 21 / (16 * pi)) * power(s, 4) * (1 + 2 * q);
  if (scene_.kernel.shape == KernelShape::wendland_c4)
    return scale * (dim_ == 2 ? 9 / (4 * pi) : 495 / (256 * pi)) * power(s, 6) *
           (1 + 3 * q + 35.0 / 12 * q * q);
  return scale * (dim_ == 2 ? 7 / (478 * pi) : 1 / (120 * pi)) * (cut(3) - 6 * cut(2) + 15 * cut(1));
}

double PairOracle::dw(double r, double h) const {
  const double q = r / h, scale = 1 / power(h, dim_ + 1), s = std::max(1 - q / 2, 0.0);
  const auto cut = [&](double reach) { return -5 * power(std::max(reach - q, 0.0), 4); };
  if (scene_.kernel.shape == KernelShape::wendland_c2)
    return scale * (dim_ == 2 ? 7 / (4 * pi) : 21 / (16 * pi)) * -5 * q * power(s, 3);
  if (scene_.kernel.shape == KernelShape::wendland_c4)
    return scale * (dim_ == 2 ? 9 / (4 * pi) : 495 / (256 * pi)) * (-14.0 / 3) * q * (1 + 2.5 * q) *
           power(s, 5);
  return scale * (dim_ == 2 ? 7 / (478 * pi) : 1 / (120 * pi)) * (cut(3) - 6 * cut(2) + 15 * cut(1));
}

double PairOracle::bare(double value) const {
  const auto alpha = [&]<class K>(K) {
    return dim_ == 2 ? K::template normalisation<2> : K::template normalisation<3>;
  };
  const double factor = scene_.kernel.shape == KernelShape::wendland_c2   ? alpha(WendlandC2{})
                        : scene_.kernel.shape == KernelShape::wendland_c4 ? alpha(WendlandC4{})
                                                                          : alpha(Quintic{});
  return value * power(h_, dim_) / factor;
}

double PairOracle::moment(int exponent) const {
  double sum = 0;
  for (int a = -4; a <= 4; ++a)
    for (int b = -4; b <= 4; ++b)
      for (int c = dim_ == 3 ? -4 : 0; c <= (dim_ == 3 ? 4 : 0); ++c) {
        const double r = scene_.start.spacing * std::sqrt(a * a + b * b + c * c);
        sum -= power(scene_.start.spacing, dim_) / dim_ * dw(r, h_) * power(r, exponent);
      }
  return sum;
}

double PairOracle::layer(const PairParticle& p) const {
  const double share = p.side != 0 ? h_ * p.colour.norm() : 0.0;
  constexpr double least = 0.02;  // what sph/pairs/pair_rows.hpp takes for noise
  return share > least ? share : 0.0;
}
Vec PairOracle::normal(const PairParticle& p) const {
  return layer(p) > 0 ? Vec(p.side * p.colour.normalized()) : Vec(Vec::Zero());
}
Mat PairOracle::capillary(const PairParticle& p) const {
  const double length = p.colour.norm();
  if (length == 0) return Mat::Zero();
  return scene_.terms.surface_tension.coefficient *
         (length * unit_ - p.colour * p.colour.transpose() / length);
}

bool PairOracle::defined(Term term, std::size_t row) const {
  const PairParticle& p = all_[row];
  switch (key(term.name)) {
    case key("WallExtrapolation"):
    case key("WallExtrapolationByDensity"):
    case key("MixtureWallExtrapolation"):
    case key("MixtureWallExtrapolationByDensity"):
    case key("WallViscosity"):
    case key("ClampSums"):
      return !p.mover;
    case key("FlowFromSolids"):
      return !p.shears;
    case key("WettedExtrapolation"):
    case key("FlowOntoSolids"):
    case key("CrackedFlowOntoSolids"):
      return p.shears;
    case key("Deformation"):
    case key("CrackedDeformation"):
    case key("CrackedBondForce"):
    case key("CrackedBondViscosity"):
    case key("CrackSums"):
    case key("BondForce"):
    case key("BondViscosity"):
    case key("BodyContact"):
    case key("BodyContactEnergy"):
    case key("CrackedBodyContact"):
    case key("CrackedBodyContactEnergy"):
      return p.modulus > 0;
    case key("WeightedPressure"):
    case key("GasPressure"):
    case key("NumberDensity"):
    case key("ViscousOperator"):
    case key("SymmetricViscousOperator"):
    case key("WallShare"):
    case key("Conduction"):
    case key("ConductionOperator"):
    case key("WallConduction"):
    case key("WallTransferConduction"):
    case key("GasFlow"):
    case key("GasHeat"):
    case key("ImplicitGasFlow"):
    case key("ImplicitGasHeat"):
    case key("GasOperator"):
    case key("GasSlope"):
    case key("WallGas"):
    case key("WaterDiffusion"):
    case key("WaterHeat"):
    case key("ViscousHeat"):
    case key("SymmetricViscousHeat"):
    case key("ClampReaction"):
      return p.mover;
    case key("Curvature"):  // elsewhere it is 0 or not, as the other rows of a block have it
    case key("CurvatureMean"):
      return layer(p) > 0;
    default:
      return true;
  }
}

PairSums PairOracle::sums(std::size_t row) const {
  PairSums sums;
  const PairParticle& i = all_[row];
  for (const PairParticle& j : all_) {
    if (&i == &j) continue;
    Vec x = Vec::Zero();
    for (std::size_t a = 0; a < 3; ++a)
      x(static_cast<Eigen::Index>(a)) = static_cast<double>(j.x[a] - i.x[a]) * of_.quantum();
    if (looks_back_) x -= (j.v - i.v) * (of_.dt() / 2);
    const double r = x.norm();
    const bool uneven = of_.fusion().values.has(Value::width);
    const double slope = uneven ? 0.5 * (dw(r, i.width) + dw(r, j.width)) : dw(r, h_);
    const Pair pair{i, j, x, r, slope, -slope / r * x};
    for (const Term term : of_.fusion().terms) add(term, pair, sums);
  }
  return sums;
}

}  // namespace sph::test
