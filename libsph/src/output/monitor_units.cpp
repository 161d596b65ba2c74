#include "output/monitor_units.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>

#include "sph/models/energies.hpp"

namespace sph {
namespace {

struct Unit {
  std::string_view quantity, in_3d, in_2d;
};

constexpr auto units = std::to_array<Unit>({
    {"x", "m", "m"},
    {"y", "m", "m"},
    {"z", "m", "m"},
    {"vx", "m/s", "m/s"},
    {"vy", "m/s", "m/s"},
    {"vz", "m/s", "m/s"},
    {"wx", "rad/s", "rad/s"},
    {"wy", "rad/s", "rad/s"},
    {"wz", "rad/s", "rad/s"},
    {"w", "rad/s", "rad/s"},
    {"angle", "rad", "rad"},
    {"qw", "", ""},
    {"qx", "", ""},
    {"qy", "", ""},
    {"qz", "", ""},
    {"fx", "N", "N/m"},
    {"fy", "N", "N/m"},
    {"fz", "N", "N/m"},
    {"tx", "N m", "N"},
    {"ty", "N m", "N"},
    {"tz", "N m", "N"},
    {"torque", "N m", "N"},
    {"px", "kg m/s", "kg/s"},
    {"py", "kg m/s", "kg/s"},
    {"pz", "kg m/s", "kg/s"},
    {"rho", "kg/m^3", "kg/m^3"},
    {"p", "Pa", "Pa"},
    {"psi", "", ""},
    {"u", "J/kg", "J/kg"},
    {"T", "K", "K"},
    {"n", "", ""},
    {"n_in", "", ""},
    {"n_out", "", ""},
    {"walls", "", ""},
    {"cover", "", ""},
    {"h", "m", "m"},
    {"mass", "kg", "kg/m"},
    {"mass_added", "kg", "kg/m"},
    {"mass_in", "kg", "kg/m"},
    {"mass_out", "kg", "kg/m"},
    {"heat", "J", "J/m"},
    {"heat_in", "J", "J/m"},
    {"gas", "kg", "kg/m"},
    {"gas_in", "kg", "kg/m"},
    {"released", "J", "J/m"},
    {"mass_rate", "kg/s", "kg/m/s"},
    {"volume_rate", "m^3/s", "m^2/s"},
    {"iterations", "", ""},
    {"residual", "", ""},
    {"v_rms", "m/s", "m/s"},
    {"temperature", "K", "K"},
    {"composition", "", ""},
});

/// The quantity at one of several points, and what of one has passed openings.
std::string_view plain(std::string_view quantity) {
  constexpr std::string_view through = "_through";
  if (std::isdigit(static_cast<unsigned char>(quantity.front())) != 0)
    quantity.remove_prefix(quantity.find('_') + 1);
  if (quantity.ends_with(through)) quantity.remove_suffix(through.size());
  return quantity;
}

}  // namespace

std::string unit_of(MonitorKind kind, std::string_view quantity, int dim) {
  if (kind == MonitorKind::energy) return dim == 2 ? "J/m" : "J";
  if (kind == MonitorKind::melt && quantity.starts_with("heat_")) return "W/m^2";
  if (kind == MonitorKind::contacts && quantity == "z") return "";
  const auto* const found = std::ranges::find(units, plain(quantity), &Unit::quantity);
  if (found == units.end()) throw std::logic_error("no unit is known of " + std::string(quantity));
  return std::string(dim == 2 ? found->in_2d : found->in_3d);
}

}  // namespace sph
