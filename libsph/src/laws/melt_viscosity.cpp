#include "sph/laws/melt_viscosity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sph/core/exact_math.hpp"
#include "sph/laws/enthalpy.hpp"

namespace sph {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double least_water = 0.02;  // percent: that of the driest rhyolites measured

double power_of_ten(double x) { return exact_exp(std::numbers::ln10 * std::clamp(x, -300.0, 300.0)); }

/// Above C alone: the liquid has long been a glass there.
double vogel(double a, double b, double c, double temperature) {
  return temperature > c ? power_of_ten(a + b / (temperature - c)) : infinite;
}

double liquid_viscosity(const Group& g, const MeltState& s) {
  const ViscosityModel& m = g.viscosity_law;
  switch (m.law) {
    case ViscosityLaw::exponential:
      return g.viscosity *
             exact_exp(std::clamp(-m.fall * (s.temperature - m.reference_temperature), -700.0, 700.0));
    case ViscosityLaw::vogel:
      return vogel(m.vogel.a, m.vogel.b, m.vogel.c, s.temperature);
    case ViscosityLaw::hess_dingwell: {
      const double w = exact_log(std::fmax(100 * s.water, least_water));
      return vogel(-3.545 + 0.833 * w, 9601 - 2368 * w, 195.7 + 32.25 * w, s.temperature);
    }
    case ViscosityLaw::constant:
      break;
  }
  return g.viscosity;
}

double of_crystals(const ViscosityModel& m, double share) {
  if (m.crystals == CrystalLaw::none || !(share > 0)) return 1;
  const double free = 1 - share / m.maximum_packing;
  return free > 0 ? exact_pow(free, -2.5) : infinite;
}

double of_bubbles(const ViscosityModel& m, double void_fraction) {
  const double liquid = 1 - void_fraction;
  switch (m.bubbles) {
    case BubbleLaw::round:
      return 1 / liquid;
    case BubbleLaw::stretched:
      return exact_pow(liquid, 5.0 / 3);
    case BubbleLaw::none:
      break;
  }
  return 1;
}

}  // namespace

double melt_viscosity(const Group& group, const MeltState& s) {
  const ViscosityModel& m = group.viscosity_law;
  const double eta = liquid_viscosity(group, s) * of_crystals(m, s.crystals) * of_bubbles(m, s.void_fraction);
  return std::fmin(std::fmax(eta, m.least), m.most.value_or(infinite));
}

double viscosity_at_start(const Group& group) {
  const ViscosityModel& m = group.viscosity_law;
  const double t = m.temperature ? *m.temperature : group.heat.temperature.value_or(0);
  const double water = group.bubbly.gas_content / (1 + group.bubbly.gas_content);
  return melt_viscosity(group, {t, water, 1 - liquid_share(group.heat.material, t), 0});
}

}  // namespace sph
