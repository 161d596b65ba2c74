#include "sph/laws/yielding.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sph/core/exact_math.hpp"
#include "sph/laws/drucker_prager.hpp"
#include "sph/laws/mohr_coulomb.hpp"
#include "sph/laws/principal_stress.hpp"

namespace sph {
namespace {

/// Deviator as stored.
SymmetricTensor in_space(const double* s, bool in_plane) {
  if (in_plane) return {s[0], s[1], -(s[0] + s[1]), s[2], 0, 0};
  return {s[0], s[1], s[2], s[3], s[4], s[5]};
}

void store(const SymmetricTensor& t, bool in_plane, double* s) {
  s[0] = t[0];
  s[1] = t[1];
  s[2] = in_plane ? t[3] : t[2];
  if (!in_plane) std::copy(t.begin() + 3, t.end(), s + 3);
}

double product(const SymmetricTensor& a, const SymmetricTensor& b) {
  return ((a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]) + 2 * ((a[3] * b[3] + a[4] * b[4]) + a[5] * b[5]);
}

double share(double part, double all) { return all > 0 ? std::fmin(part / all, 1.0) : 0.0; }

/// Of the deviator `end` on the plastic strain that `trial` left behind.
double shear_work(const StrengthConstants& k, const SymmetricTensor& trial, const SymmetricTensor& end) {
  SymmetricTensor gone{};
  for (std::size_t c = 0; c < gone.size(); ++c) gone[c] = trial[c] - end[c];
  return product(end, gone) / (2 * k.shear_modulus);
}

/// s1 - s3 <= 2 sqrt(J2), |s2| <= sqrt(J2/3), s1 <= 2 sqrt(J2/3) of a deviator: most rock is elastic, and needs no axes.
bool surely_elastic(const StrengthConstants& k, double shear, double mean) {
  constexpr double least = 0.57735026918962573, most = 1.1547005383792517;  // 1, 2 over sqrt(3), rounded up
  const double tension = std::fmin(k.tensile_strength, cone_tip(k));
  return 2 * shear + (2 * mean + least * shear) * k.sin_friction <= 2 * k.cohesion * k.cos_friction &&
         mean + most * shear <= tension;
}

Yielding::End to_cone(const StrengthConstants& k, const SymmetricTensor& t, double shear, double p,
                      double* s) {
  const ConeReturn end = return_to_drucker_prager(k, shear, -p);
  if (end.shear == shear && end.mean == -p) return {false, p, 0};
  const double scale = shear > 0 ? end.shear / shear : 0.0;
  SymmetricTensor scaled = t;
  for (double& x : scaled) x *= scale;
  store(scaled, k.in_plane, s);
  return {true, -end.mean, end.plastic_shear, share(end.opening, end.plastic_volume),
          shear_work(k, t, scaled)};
}

Yielding::End to_planes(const StrengthConstants& k, const SymmetricTensor& t, double p, double* s) {
  PrincipalAxes principal = principal_axes(t);
  std::array<double, 3> trial{};
  for (std::size_t i = 0; i < 3; ++i) trial[i] = principal.values[i] - p;
  const StressReturn end = return_to_mohr_coulomb(k, trial);
  if (end.region == StressRegion::elastic) return {false, p, 0};
  const double mean = ((end.stress[0] + end.stress[1]) + end.stress[2]) / 3;
  for (std::size_t i = 0; i < 3; ++i) principal.values[i] = end.stress[i] - mean;
  const SymmetricTensor now = tensor_of(principal);
  store(now, k.in_plane, s);
  return {true, -mean, end.plastic_shear, share(end.opening, end.plastic_volume), shear_work(k, t, now)};
}

}  // namespace

Yielding::Yielding(const Group& group, int dim, double spacing) : law_(group.solid.strength->law) {
  const Strength& s = *group.solid.strength;
  constexpr double degree = std::numbers::pi / 180;
  at_start_.sin_friction = exact_sin(degree * s.friction_angle);
  at_start_.cos_friction = exact_cos(degree * s.friction_angle);
  at_start_.sin_dilatancy = exact_sin(degree * s.dilatancy_angle);
  at_start_.cohesion = s.cohesion;
  at_start_.tensile_strength = s.tensile_strength.value_or(cone_tip(at_start_));
  at_start_.bulk_modulus = group.eos.bulk_modulus;
  at_start_.shear_modulus = group.solid.shear_modulus;
  at_start_.in_plane = dim == 2;
  if (!s.fracture_energy) return;
  residual_share_ = s.residual_cohesion / s.cohesion;
  softening_shear_ =
      2 * *s.fracture_energy / ((s.cohesion - s.residual_cohesion) * at_start_.cos_friction * spacing);
}

StrengthConstants Yielding::constants(double plastic_shear) const {
  StrengthConstants now = at_start_;
  if (!(softening_shear_ < std::numeric_limits<double>::infinity())) return now;
  const double share = 1 - (1 - residual_share_) * std::fmin(plastic_shear / softening_shear_, 1.0);
  now.cohesion *= share;
  now.tensile_strength *= share;
  return now;
}

// Drucker-Prager's cut-off is that of the mean stress.
double Yielding::closed_pressure(const double* s, double p) const {
  if (law_ == StrengthLaw::drucker_prager) return std::fmin(p, 0.0);
  return p + std::fmin(principal_axes(in_space(s, at_start_.in_plane)).values[0] - p, 0.0);
}

Yielding::End Yielding::bring_back(double* s, double p, double plastic_shear) const {
  const StrengthConstants k = constants(plastic_shear);
  const SymmetricTensor t = in_space(s, k.in_plane);
  const double shear = std::sqrt(product(t, t) / 2);
  if (law_ == StrengthLaw::drucker_prager) return to_cone(k, t, shear, p, s);
  if (surely_elastic(k, shear, -p)) return {false, p, 0};
  return to_planes(k, t, p, s);
}

}  // namespace sph
