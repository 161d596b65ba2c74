#include "sph/models/faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "pairs/for_rows.hpp"

namespace sph {
namespace {

// V_i V_j (p_i + p_j) of two such particles is a number of single precision, and so is what else pairs have of them.
constexpr double most_pressure = 1e24;  // [Pa]
constexpr double most_expansion = 1e6;  // of a volume, and of its inverse, in cells of the start's lattice

std::string quantity_text(std::string_view name, double value, std::string_view unit) {
  return std::isfinite(value) ? fmt::format("a {} of {:.3g} {}", name, value, unit)
                              : fmt::format("no finite {}", name);
}

}  // namespace

void find_fault(const SphConstants& k, const FaultView& p, std::size_t i, const Step& step,
                const std::string& what) {
  const auto d = static_cast<std::size_t>(p.dim());
  const std::uint64_t id = p.get<Field::id>()[i];
  step.findings.add(id, [&] {
    std::vector<double> at;
    for (std::size_t a = 0; a < d; ++a)
      at.push_back(k.scale.metres(k.wrap(static_cast<int>(a), p.get<Field::position>()[i * d + a])));
    return fmt::format("{}particle {} of \"{}\" {} {}", step_text(step.global.step), id,
                       k.scene->groups[p.get<Field::group>()[i]].name, place_text(at), what);
  });
}

void find_out_of_range(const SphConstants& k, const RangeView& p, std::size_t first, std::size_t last,
                       const Step& step) {
  const auto d = static_cast<std::size_t>(p.dim()), n = d * (d + 1) / 2;
  const double* mass = p.get<Field::mass>();
  const double* rho = p.get<Field::density>();
  const double* pressure = p.get<Field::pressure>();
  const double* stress = p.get<Field::stress>();
  const double thinnest = k.row_scale.inverse_volume / most_expansion;
  const double densest = k.row_scale.inverse_volume * most_expansion;
  for (std::size_t i = first; i < last; ++i) {
    double most = std::abs(pressure[i]);
    for (std::size_t c = 0; stress != nullptr && c < n; ++c) most = larger(std::abs(stress[i * n + c]), most);
    if (most < most_pressure && rho[i] > mass[i] * thinnest && rho[i] < mass[i] * densest) continue;
    find_fault(k, p, i, step,
               fmt::format("has {} and {}, out of all range; reduce time.dt or time.cfl",
                           quantity_text("pressure", pressure[i], "Pa"),
                           quantity_text("density", rho[i], "kg/m^3")));
  }
}

}  // namespace sph
