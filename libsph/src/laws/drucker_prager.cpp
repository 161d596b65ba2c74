#include "sph/laws/drucker_prager.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace sph {
namespace {

double slope_of(double sin, double cos, bool in_plane) {
  if (!in_plane) return 2 * sin / (std::numbers::sqrt3 * (3 - sin));
  const double tan = sin / cos;
  return tan / std::sqrt(9 + 12 * (tan * tan));
}

}  // namespace

DruckerPragerCone drucker_prager_cone(const StrengthConstants& k) {
  const double sin = k.sin_friction, cos = k.cos_friction, tan = sin / cos;
  const double limit = k.in_plane ? 3 * k.cohesion / std::sqrt(9 + 12 * (tan * tan))
                                  : 6 * k.cohesion * cos / (std::numbers::sqrt3 * (3 - sin));
  const double out = k.sin_dilatancy;
  return {slope_of(sin, cos, k.in_plane), limit, slope_of(out, std::sqrt(1 - out * out), k.in_plane)};
}

// Cone, cap, and where they meet; each is linear in how much plastic shear and volume there is.
ConeReturn return_to_drucker_prager(const StrengthConstants& k, double shear, double mean) {
  constexpr double rounding = 1e-13;
  const DruckerPragerCone cone = drucker_prager_cone(k);
  const double tip = cone.slope > 0 ? cone.limit / (3 * cone.slope) : std::numeric_limits<double>::infinity();
  const double cap = std::fmin(k.tensile_strength, tip);
  const double tolerance = rounding * ((shear + std::fabs(mean)) + k.cohesion);
  const double beyond = (shear + 3 * cone.slope * mean) - cone.limit;
  if (!(beyond > tolerance || mean - cap > tolerance)) return {shear, mean};

  const double amount =
      std::fmax(beyond / (k.shear_modulus + 9 * k.bulk_modulus * (cone.slope * cone.flow_slope)), 0.0);
  ConeReturn end{shear - k.shear_modulus * amount, mean - 3 * k.bulk_modulus * (cone.flow_slope * amount)};
  if (!(end.mean <= cap)) {
    const double allowed = std::fmax(cone.limit - 3 * cone.slope * cap, 0.0);
    end = {std::fmin(shear, allowed), cap};
  } else if (cone.slope > 0) {
    end.shear = std::fmin(end.shear, cone.limit - 3 * cone.slope * end.mean);
  }
  end.plastic_shear = (shear - end.shear) / k.shear_modulus;
  end.plastic_volume = (mean - end.mean) / k.bulk_modulus;
  end.opening = std::fmax(end.plastic_volume - 3 * cone.flow_slope * end.plastic_shear, 0.0);
  return end;
}

}  // namespace sph
