// The formulas: of forces, of what is summed beside them.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "pair_oracle.hpp"

namespace sph::test {
namespace {

// Numbers that were tuned, as libsph/src/models/sph_constants.cpp has them.
constexpr double contact_stiffness = 0.5, interface_damping = 0.03, background = 0.75;

double approach(const Vec& x, const Vec& dv) { return std::min(x.dot(dv), 0.0); }

}  // namespace

void PairOracle::add(Term term, const Pair& pair, PairSums& sums) const {
  const PairParticle &i = pair.i, &j = pair.j;
  const Vec &x = pair.x, &grad = pair.gradient;
  const double r = pair.r, slope = pair.slope;
  const double lattice_volume =
      power(scene_.start.spacing, dim_);  // the unit of volumes in sums without units
  const Vec dv = j.v - i.v, dd = j.direction - i.direction;
  const auto one = [&](Field f, int k, double value) {
    sums.of[static_cast<std::size_t>(f)][static_cast<std::size_t>(k)].add(value);
  };
  const auto vector = [&](Field f, int first, const Vec& value) {
    for (int a = 0; a < dim_; ++a) one(f, first + a, value(a));
  };
  const auto matrix = [&](Field f, int first, const Mat& value) {
    for (int a = 0; a < dim_; ++a)
      for (int b = 0; b < dim_; ++b) one(f, first + a * dim_ + b, value(a, b));
  };
  const auto gravity = [&] {
    double head = 0;
    for (int a = 0; a < dim_; ++a) head += scene_.domain.gravity[static_cast<std::size_t>(a)] * x(a);
    return head;
  }();
  const double rho = 0.5 * (i.density + j.density);
  const double w_ij = w(r, h_);
  const double delta = 2 * scene_.terms.density_diffusion * h_;
  switch (key(term.name)) {
    case key("Divergence"):
      return one(Field::divergence, 0, j.volume * dv.dot(grad));
    case key("WeightedDivergence"):
      return one(Field::divergence, 0, (j.mover ? j.density / rho : 1.0) * j.volume * dv.dot(grad));
    case key("VelocityGradient"):
      return matrix(Field::velocity_gradient, 0, j.volume * dv * grad.transpose());
    case key("SlippingGradient"):
      return matrix(
          Field::velocity_gradient, 0,
          j.shears ? Mat(j.volume * dv * grad.transpose()) : Mat(j.volume * dv.dot(grad) / dim_ * unit_));
    case key("IdaGradient"):
      return matrix(Field::velocity_gradient, 0, j.volume * j.v * grad.transpose());
    case key("DensityDiffusion"):
    case key("PulledDensityDiffusion"): {
      double rest = gravity;
      if (term.name == "PulledDensityDiffusion") {
        double to_i = 0, to_j = 0;
        for (std::size_t a = 0; a < static_cast<std::size_t>(dim_); ++a) {
          to_i += power(static_cast<double>(i.x[a]) * of_.quantum() - scene_.domain.pull_centre[a], 2);
          to_j += power(static_cast<double>(j.x[a]) * of_.quantum() - scene_.domain.pull_centre[a], 2);
        }
        rest += 0.5 * scene_.domain.central_pull * (to_i - to_j);
      }
      return one(Field::diffusion, 0,
                 i.group != j.group
                     ? 0.0
                     : delta * j.volume * (i.pressure - j.pressure + 0.5 * (i.weight + j.weight) * rest) /
                           std::max(i.sound, j.sound) * slope / r);
    }
    case key("MixtureDensityDiffusion"):
      return one(Field::diffusion, 0,
                 i.group != j.group
                     ? 0.0
                     : delta * j.volume *
                           (i.pressure - j.pressure + 0.5 * (i.rest_gradient + j.rest_gradient).dot(x)) /
                           std::max(i.sound, j.sound) * slope / r);
    case key("UniformDensityDiffusion"): {
      const Group& fluid = scene_.groups[light];
      return one(
          Field::diffusion, 0,
          (j.mover ? delta : 0.0) * j.volume *
              (i.pressure - j.pressure + (fluid.density - scene_.domain.background.density) * gravity) /
              std::sqrt(fluid.eos.bulk_modulus / fluid.density) * slope / r);
    }
    case key("Xsph"):
      return vector(Field::added, 0, (j.mover ? j.volume * j.density / rho : 0.0) * (w_ij / h_) * dv);
    case key("ArtificialStress"): {
      const double pull = std::max(x.dot((i.stress + j.stress) * x) / (r * r), 0.0);
      const double near = power(w_ij / w(scene_.start.spacing, h_), 4);
      return vector(Field::added, 0,
                    (i.shears && j.shears ? -j.volume / i.density * near * pull : 0.0) * grad);
    }
    case key("Concentration"):
      vector(Field::spread, 0, j.volume * (1 + 0.2 * power(w_ij / w(scene_.start.spacing, h_), 4)) * grad);
      one(Field::spread, dim_, j.volume * w_ij / h_);
      return one(Field::spread, dim_ + 1, j.mover ? j.volume * w_ij * power(dv.dot(x) / r, 2) / h_ : 0.0);
    case key("ColourGradient"):
      return vector(Field::colour_gradient, 0, i.side * j.side == -1 ? Vec(j.volume * grad) : Vec(0 * grad));
    case key("WallExtrapolation"):
    case key("WallExtrapolationByDensity"):
    case key("MixtureWallExtrapolation"):
    case key("MixtureWallExtrapolationByDensity"): {
      if (!j.mover) return;
      const bool mixture = term.name.starts_with("Mixture");
      const double rise = mixture ? j.rest_gradient.dot(x) : j.weight * gravity;
      const double part = bare(w_ij), of_pressure = part * (j.pressure - rise);
      if (term.name.ends_with("ByDensity")) {
        one(Field::wall_sums_by_density, j.heavy ? 2 : 0, part);
        return one(Field::wall_sums_by_density, j.heavy ? 3 : 1, of_pressure);
      }
      one(Field::wall_sums, 0, part);
      one(Field::wall_sums, 1, of_pressure);
      vector(Field::wall_sums, 2, part * j.v);
      return vector(Field::wall_sums, 2 + dim_, part * x / h_);
    }
    case key("WettedExtrapolation"): {
      if (j.shears) return;
      const double part = bare(w_ij), rise = j.weight * gravity - j.density * i.frame.dot(x);
      one(Field::wall_sums, 0, part);
      one(Field::wall_sums, 1, part * (j.pressure - rise));
      vector(Field::wall_sums, 2, part * j.v);
      return vector(Field::wall_sums, 2 + dim_, part * x / h_);
    }
    case key("BorneByFluid"): {
      if (i.shears && j.shears && !are_faces(pair)) return;
      const double pressure = 0.5 * j.volume * (i.wet_pressure + j.wet_pressure) * slope / r / h_;
      for (int a = 0; a < dim_; ++a)
        for (int b = a; b < dim_; ++b)
          one(Field::borne_by_fluid, symmetric_index(a, b, dim_), pressure * x(a) * x(b));
      return;
    }
    case key("CrackedFlowOntoSolids"):
      if (are_faces(pair))
        return one(Field::flux_sums, 1, bare(j.volume / lattice_volume * h_ * dv.dot(grad)));
      [[fallthrough]];
    case key("FlowOntoSolids"):
      if (j.shears) return;
      one(Field::flux_sums, 0, bare(w_ij));
      return one(Field::flux_sums, 1, bare(j.volume / lattice_volume * h_ * dv.dot(grad)));
    case key("FlowFromSolids"):
      return one(Field::divergence, 0, j.flux * w_ij * lattice_volume / (i.volume / lattice_volume) / h_);
    case key("WallShare"):
      if (j.mover) return;
      vector(Field::wall_share, 0, j.volume * grad);
      return one(Field::wall_share, dim_, j.volume * w_ij / h_);
    case key("Curvature"): {
      const Vec n = normal(i), along = x - n * n.dot(x);
      const double weight = layer(j) * j.volume / lattice_volume * bare(w_ij);
      one(Field::curvature_sums, 0, weight * (normal(j) - n).dot(along) / h_);
      return one(Field::curvature_sums, 1, weight * along.squaredNorm() / (h_ * h_));
    }
    case key("CurvatureMean"): {
      const double weight = layer(j) * j.volume / lattice_volume * bare(w_ij);
      one(Field::curvature_sums, 0, j.side != 0 ? weight * j.curvature : 0.0);
      return one(Field::curvature_sums, 1, weight);
    }
    case key("ViscousOperator"):
    case key("SymmetricViscousOperator"): {
      double profile = 1;  // of a flow that is 0 at the wall's face and 1 at this particle
      if (i.slope.norm() > 0) profile = std::max(-i.slope.dot(x) / h_, 0.0);
      const double eta = j.mover ? harmonic(i.viscosity, j.viscosity) : i.viscosity * profile;
      const double drag = -2 * eta * i.volume * j.volume * slope / r;
      if (term.name == "ViscousOperator") {
        vector(Field::viscous_sums, 0, drag / second_ * dd);
        return one(Field::viscous_sums, dim_, drag / second_);
      }
      vector(Field::viscous_sums, 0, (dim_ + 2) * drag / fourth_ * dd.dot(x) * x);
      return one(Field::viscous_sums, dim_, (dim_ + 2) * drag / fourth_ * r * r / dim_);
    }
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
      return add_exchange(pair, term, sums);
    case key("WallViscosity"):
      if (!j.mover) return;
      one(Field::wall_viscosity, 0, bare(w_ij) * j.volume / lattice_volume);
      return one(Field::wall_viscosity, 1, bare(w_ij) * j.volume / lattice_volume * j.viscosity / h_);
    case key("NumberDensity"):
    case key("GasMoments"): {
      const double wide = j.mover ? i.width : std::max(i.width, h_),
                   part = j.mover ? 1 : j.volume / lattice_volume;
      const int of = j.mover ? 0 : 1;
      // Neither sum has the kernel's factor, nor that of its width.
      const double unwidened = power(wide / h_, dim_);
      const double value = part * bare(w(r, wide)) * unwidened;
      if (term.name == "NumberDensity") return one(Field::number_density, of, value);
      one(Field::gas_moments, of, part * r * bare(dw(r, wide)) * unwidened);
      if (!j.mover) return;
      for (int a = 0, k = 2; a < dim_; ++a)
        for (int b = a; b < dim_; ++b, ++k) one(Field::gas_moments, k, value * x(a) * x(b) / (h_ * h_));
      return matrix(Field::gas_moments, 2 + dim_ * (dim_ + 1) / 2, value * dv * x.transpose() / h_);
    }
    case key("ShockHeating"): {
      const Vec force =
          2 * harmonic(i.viscosity, j.viscosity) * i.volume * j.volume / second_ * slope / r * -dv +
          shock(pair);
      const double mean = harmonic(i.density, j.density);
      const double jump = std::abs(i.pressure - j.pressure + mean * gravity);
      const double conducted = i.energy > 0 && j.energy > 0
                                   ? i.volume * j.volume * scene_.terms.gas.conduction * mean *
                                         std::sqrt(jump / mean) * (j.energy - i.energy) * grad.norm()
                                   : 0.0;
      one(Field::heating, 0, conducted + 0.5 * force.dot(dv));
      return vector(Field::heating, 1, force);
    }
    case key("BodyContact"):
    case key("BodyContactEnergy"):
    case key("CrackedBodyContact"):
    case key("CrackedBodyContactEnergy"):
      return add_contact(pair, term, sums);
    case key("Deformation"):
    case key("BondForce"):
    case key("BondViscosity"):
    case key("ClampSums"):
    case key("ClampReaction"):
    case key("CrackedDeformation"):
    case key("CrackedBondForce"):
    case key("CrackedBondViscosity"):
    case key("CrackSums"):
      return add_bond(pair, term, sums);
    default:
      return add_force(pair, term, sums);
  }
}

// An overlap is a difference of two lengths: what is rounded is as large as they are.
void PairOracle::add_contact(const Pair& pair, Term term, PairSums& sums) const {
  const PairParticle &i = pair.i, &j = pair.j;
  const Vec& x = pair.x;
  const double r = pair.r;
  const bool across = i.body == j.body;
  if (across && !(term.name.starts_with("Cracked") && faces(pair, 0.8))) return;
  const double d = scene_.start.spacing, shorter = 0.5 * (i.crack_closing + j.crack_closing),
               touch = across ? bond(pair).X.norm() * (1 - shorter) : d, overlap = touch - r;
  if (overlap < 0 || touch >= scene_.list_range()) return;
  const double k = contact_stiffness * std::min(i.modulus, j.modulus) * power(d, dim_) / (h_ * h_);
  if (term.name.ends_with("Energy")) {
    sums.of[static_cast<std::size_t>(Field::contact_energy)][0].add(0.25 * k * overlap * overlap,
                                                                    0.25 * k * overlap * touch);
    return;
  }
  for (int a = 0; a < dim_; ++a)
    sums.of[static_cast<std::size_t>(Field::force)][static_cast<std::size_t>(a)].add(
        -k * overlap / r * x(a), k * touch / r * std::abs(x(a)));
}

Vec PairOracle::shock(const Pair& pair) const {
  const PairParticle &i = pair.i, &j = pair.j;
  const Vec &x = pair.x, &grad = pair.gradient;
  const double r = pair.r;
  const Vec dv = j.v - i.v;
  if (!(dv.dot(x) < 0)) return Vec::Zero();
  const double at_i = x.dot(i.gradient * x), at_j = x.dot(j.gradient * x);
  const double smooth = at_i * at_j > 0 ? 2 * at_i * at_j / (at_i + at_j) : 0.0;
  const double h = 0.5 * (i.width + j.width);
  const double mu = h * std::min(dv.dot(x) - smooth, 0.0) / (r * r + 0.01 * h * h);
  const double sound = 0.5 * (i.sound + j.sound);
  return i.volume * j.volume * harmonic(i.density, j.density) *
         (scene_.terms.artificial_viscosity * sound - scene_.terms.gas.quadratic_viscosity * mu) * mu * grad;
}

void PairOracle::add_force(const Pair& pair, Term term, PairSums& sums) const {
  const PairParticle &i = pair.i, &j = pair.j;
  const Vec &x = pair.x, &grad = pair.gradient;
  const double r = pair.r, slope = pair.slope;
  const Vec dv = j.v - i.v;
  const double both = i.volume * j.volume, sigma = scene_.terms.surface_tension.coefficient;
  const auto force = [&]() -> Vec {
    switch (key(term.name)) {
      case key("Pressure"):
        return -both * (i.pressure + j.pressure) * grad;
      case key("WeightedPressure"): {
        const double rho_j = j.mover ? j.density : i.density;
        const double p_j = j.mover ? j.pressure : j.wall_pressures[i.heavy ? 1 : 0];
        return -2 * both * (rho_j * i.pressure + i.density * p_j) / (i.density + rho_j) * grad;
      }
      case key("Viscosity"):
        return 2 * harmonic(i.viscosity, j.viscosity) * both / second_ * slope / r * -dv;
      case key("UniformViscosity"):
        return 2 * scene_.groups[light].viscosity * both / second_ * slope / r * -dv;
      case key("SymmetricViscosity"):
        return -2 * (dim_ + 2) * harmonic(i.viscosity, j.viscosity) * both / fourth_ * slope / r * dv.dot(x) *
               x;
      case key("StressDivergence"):
        return both * (i.stress + j.stress) * grad;
      case key("SlippingStress"): {
        const Mat mean = i.stress + j.stress;
        return both * (i.shears && j.shears ? mean : Mat(mean.trace() / dim_ * unit_)) * grad;
      }
      case key("IdaStress"):
        return both * j.stress * grad;
      case key("CrackedWettedPressure"):
        if (are_faces(pair)) return Vec(-both * (i.wet_pressure + j.wet_pressure) * grad);
        [[fallthrough]];
      case key("WettedPressure"):
        return i.shears && j.shears ? Vec(Vec::Zero())
                                    : Vec(-both * (i.wet_pressure + j.wet_pressure) * grad);
      case key("WettedViscosity"):
      case key("WettedSymmetricViscosity"): {
        if (i.shears && j.shears) return Vec::Zero();
        const double eta = i.shears   ? j.viscosity
                           : j.shears ? i.viscosity
                                      : harmonic(i.viscosity, j.viscosity);
        const Vec seen = j.wet_v - i.wet_v;
        if (term.name == "WettedViscosity") return 2 * eta * both / second_ * slope / r * -seen;
        return -2 * (dim_ + 2) * eta * both / fourth_ * slope / r * seen.dot(x) * x;
      }
      case key("WettedArtificialViscosity"):
        if (i.shears || j.shears) return Vec::Zero();
        [[fallthrough]];
      case key("ArtificialViscosity"):
        return both * 0.5 * (i.density + j.density) * scene_.terms.artificial_viscosity * 0.5 *
               (i.sound + j.sound) * h_ * approach(x, dv) / (r * r + 0.01 * h_ * h_) * grad;
      case key("SurfaceTension"):
        return both * (capillary(i) + capillary(j)) * grad;
      case key("TensionJump"):
      case key("WeightedTensionJump"): {
        Vec sum = -2 * both * background * sigma / h_ * grad;
        if (i.side * j.side != -1) return sum;
        const double share = term.name == "TensionJump" ? 1 : 2 * i.density / (i.density + j.density);
        sum -= i.side * both * share * sigma * 0.5 * (i.curvature + j.curvature) * grad;
        const double impedance = harmonic(i.density, j.density) * std::min(i.sound, j.sound);
        return sum + both * interface_damping * impedance * h_ * dv.dot(x) / (r * r) * grad;
      }
      case key("GasPressure"): {
        if (!j.mover) return both * (i.pressure + j.pressure) * dw(r, std::max(i.width, h_)) / r * x;
        const double of_i = i.pressure * i.volume * i.volume * i.correction * dw(r, i.width);
        const double of_j = j.pressure * j.volume * j.volume * j.correction * dw(r, j.width);
        return (of_i + of_j) / r * x;
      }
      case key("ShockViscosity"):
        return shock(pair);
      default:
        throw std::logic_error("no formula for " + std::string(term.name));
    }
  };
  const Vec value = force();
  for (int a = 0; a < dim_; ++a)
    sums.of[static_cast<std::size_t>(Field::force)][static_cast<std::size_t>(a)].add(value(a));
}

}  // namespace sph::test
