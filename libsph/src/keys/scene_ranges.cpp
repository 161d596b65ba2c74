// Constants that pairs could not multiply. What rows hold of them (pairs/pair_rows.hpp), the product of any two
// and that with two volumes of up to 1e6 cells must be numbers, in mixed precision single ones: a run would end
// at its first step, with the advice to make that shorter. No pressure may reach 1e24 Pa anyway
// (models/faults.cpp).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "keys/scene_resolve.hpp"
#include "sph/laws/eos/law.hpp"

namespace sph {
namespace {

struct Range {
  double least, most;
  [[nodiscard]] bool holds(double x) const { return !(x < least || x > most); }
};
struct Quantity {
  std::string_view name, unit;
  Range single, twice;
};
constexpr Range row_single{0, 1e18}, row_double{0, 1e72}, pressures{0, 1e24};
constexpr Quantity density{"rho_0", "kg/m^3", {1e-12, 1e14}, {1e-48, 1e48}};
constexpr Quantity sound{"c", "m/s", {1e-18, 1e9}, {1e-72, 1e48}};
constexpr Quantity bulk_modulus{"K", "Pa", pressures, pressures};
constexpr Quantity shear_modulus{"mu", "Pa", pressures, pressures};
constexpr Quantity outer_pressure{"p", "Pa", pressures, pressures};
constexpr Quantity contact_energy{"(K + 4/3 mu) dx^D", "J", {0, 1e36}, {0, 1e144}};
constexpr Quantity specific_energy{"u", "J/kg", row_single, row_double};
constexpr Quantity viscosity{"eta / h", "Pa s/m", row_single, row_double};
// No star is as hot; its fourth power must be a number.
constexpr Quantity temperature{"T", "K", {0, 1e12}, {0, 1e12}};
// Exchanges are in double precision always.
constexpr Range row_positive{1e-72, 1e72};
constexpr Quantity specific_heat{"c_p", "J/kg/K", row_positive, row_positive};
constexpr Quantity latent_heat{"L", "J/kg", row_double, row_double};
constexpr Quantity expansion{"beta", "1/K", row_double, row_double};
constexpr Quantity exsolution{"1 / tau", "1/s", row_double, row_double};
constexpr Quantity conductivity{"k / h", "W/m^2/K", row_double, row_double};
constexpr Quantity heat_flux{"|q|", "W/m^2", row_double, row_double};
constexpr Quantity face_flux{"h_c", "W/m^2/K", row_double, row_double};
constexpr Quantity permeability{"k / h", "m", row_double, row_double};
constexpr Quantity water{"rho_0 D / h", "kg/m^2/s", row_double, row_double};
constexpr Quantity tension{"sigma / h", "Pa", row_single, row_double};
constexpr Quantity head{"g h", "m^2/s^2", row_single, row_single};  // far above the square of light's speed
constexpr Quantity potential{"a potential", "m^2/s^2", row_single, row_single};

class Ranges {
 public:
  explicit Ranges(const Scene& scene) : mixed_(scene.terms.precision == Precision::mixed) {}

  template <class Table>
  void check(const Table& table, typename Table::template Name<> key, const Quantity& of,
             double value) const {
    const Range& range = mixed_ ? of.single : of.twice;
    if (range.holds(value)) return;
    const std::string bounds = range.least > 0 ? fmt::format("{:.0e} to {:.0e}", range.least, range.most)
                                               : fmt::format("at most {:.0e}", range.most);
    table.fail(
        key, fmt::format("makes {} = {:.3g} {}", of.name, value, of.unit),
        mixed_ && of.twice.holds(value)
            ? fmt::format("single precision bears {}: set precision = \"double\" or check its unit", bounds)
            : fmt::format("it must be {}: check its unit", bounds));
  }

 private:
  bool mixed_;
};

/// What a wall has from another group is looked at there.
void check_group(const Ranges& ranges, const GroupReader& table, const Scene& scene, const Group& g) {
  using Name = GroupReader::Name<>;
  const Name stiff = table.has("sound_speed")                ? Name("sound_speed")
                     : g.eos.law->kind == EosKind::ideal_gas ? Name("start_pressure")
                                                             : Name("bulk_modulus");
  if (table.has("density")) ranges.check(table, "density", density, g.density);
  if (table.has("viscosity"))
    ranges.check(table, "viscosity", viscosity, g.viscosity / scene.kernel.smoothing_length);
  if (!table.has(stiff)) return;
  ranges.check(table, stiff, bulk_modulus, g.eos.bulk_modulus);
  ranges.check(table, stiff, sound, sound_at_rest(g));
  if (g.eos.law->kind == EosKind::ideal_gas)
    ranges.check(table, stiff, specific_energy,
                 g.eos.gas.start_pressure / ((g.eos.gas.heat_ratio - 1) * g.density));
  if (g.kind != GroupKind::solid) return;
  if (!is_rigid(g))
    ranges.check(table, table.has("shear_modulus") ? Name("shear_modulus") : Name("poisson_ratio"),
                 shear_modulus, g.solid.shear_modulus);
  if (g.solid.lagrangian != Lagrangian::total) return;
  double energy = g.eos.bulk_modulus + 4.0 / 3 * g.solid.shear_modulus;
  for (int a = 0; a < scene.dim; ++a) energy *= scene.start.spacing;
  ranges.check(table, stiff, contact_energy, energy);
}

void check_exchange(const Ranges& ranges, const GroupReader& table, const Group& g, double h) {
  const auto inner = [&]<auto & of>(GroupReader::Name<> name, auto look) {
    if (table.has(name)) look(table.table<of>());
  };
  inner.operator()<keys::heat>("heat", [&](const auto& heat) {
    ranges.check(heat, "specific_heat", specific_heat, g.heat.material.specific_heat);
    ranges.check(heat, "conductivity", conductivity, g.heat.material.conductivity / h);
    ranges.check(heat, "latent_heat", latent_heat, g.heat.material.latent_heat);
    ranges.check(heat, "expansion", expansion, g.heat.material.expansion);
  });
  inner.operator()<keys::heat_transfer>("heat_transfer", [&](const auto& transfer) {
    ranges.check(transfer, "coefficient", face_flux, g.heat.transfer.coefficient);
    ranges.check(transfer, "temperature", temperature, g.heat.transfer.temperature);
  });
  inner.operator()<keys::radiation>("radiation", [&](const auto& radiation) {
    ranges.check(radiation, "temperature", temperature, g.heat.radiation.temperature);
  });
  inner.operator()<keys::permeability>("permeability", [&](const auto& inside) {
    ranges.check(inside, "coefficient", permeability, g.bubbly.permeability.coefficient / h);
  });
  if (g.heat.temperature) ranges.check(table, "temperature", temperature, *g.heat.temperature);
  if (g.heat.wall_flux) ranges.check(table, "heat_flux", heat_flux, std::abs(*g.heat.wall_flux));
  if (const double tau = g.bubbly.exsolution_time; tau > 0)
    ranges.check(table, "exsolution_time", exsolution, 1 / tau);
  ranges.check(table, "water_diffusivity", water, g.density * g.bubbly.water_diffusivity / h);
}

}  // namespace

void check_ranges(const TopReader& top, const DomainReader& domain, const StartReader& start,
                  const TermsReader& terms, const Scene& scene) {
  const Ranges ranges(scene);
  const double h = scene.kernel.smoothing_length;
  const std::vector<GroupReader> groups = top.tables<keys::group>();
  for (std::size_t k = 0; k < groups.size(); ++k)
    if (const Group& g = scene.groups[k]; g.kind != GroupKind::grain) {
      check_group(ranges, groups[k], scene, g);
      check_exchange(ranges, groups[k], g, h);
    }
  const auto come = [&](const auto& tables, const auto& all) {
    for (std::size_t k = 0; k < all.size(); ++k)
      if (all[k].temperature) ranges.check(tables[k], "temperature", temperature, *all[k].temperature);
  };
  come(top.tables<keys::reset>(), scene.domain.resets);
  come(top.tables<keys::inlet>(), scene.domain.openings.inlets);
  double square = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    ranges.check(domain, "gravity", head, std::abs(scene.domain.gravity[a]) * h);
    const double c = scene.domain.pull_centre[a];
    const double away = std::max(std::abs(scene.domain.lower[a] - c), std::abs(scene.domain.upper[a] - c));
    square += away * away;
  }
  ranges.check(domain, "central_pull", potential, 0.5 * scene.domain.central_pull * square);
  ranges.check(domain, "surface_pressure", outer_pressure, scene.domain.surface_pressure);
  ranges.check(start, "uniform_pressure", outer_pressure, scene.start.uniform_pressure);
  if (terms.has("surface_tension"))
    ranges.check(terms.table<keys::surface_tension>(), "coefficient", tension,
                 scene.terms.surface_tension.coefficient / h);
}

}  // namespace sph
