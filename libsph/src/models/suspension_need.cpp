#include "sph/models/suspension_need.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "models/grain_constants.hpp"
#include "sph/core/exact_math.hpp"
#include "sph/laws/drag/law.hpp"
#include "sph/models/drag_force.hpp"
#include "sph/scene/melt_grid.hpp"

namespace sph {
namespace {

double gravity_of(const Scene& scene) {
  double g2 = 0;
  for (const double g : scene.domain.gravity) g2 += g * g;
  return std::sqrt(g2);
}

/// Area of the floor: the domain's across the axis that is nearest to gravity [m^2].
double floor_area(const Scene& scene) {
  std::size_t down = 2;
  for (std::size_t a = 0; a < 2; ++a)
    if (std::fabs(scene.domain.gravity[a]) > std::fabs(scene.domain.gravity[down])) down = a;
  double area = 1;
  for (std::size_t a = 0; a < 3; ++a)
    if (a != down) area *= scene.domain.upper[a] - scene.domain.lower[a];
  return area;
}

/// Of those that the scene names, of which alone the start is made: between them all others [K].
std::vector<double> temperatures_of(const Scene& scene) {
  const MeltControl& melt = scene.domain.melt;
  if (melt.diffusivity == 0) return {melt.reference_temperature};
  std::vector<double> out;
  for (const Group& g : scene.groups)
    if (g.kind == GroupKind::melt) out.push_back(g.heat.temperature.value_or(0));
  for (const MeltSide& s : melt.sides)
    if (s.temperature) out.push_back(*s.temperature);
  return out;
}

/// Where the scene is warmest [Pa s].
double thinnest_melt(const Scene& scene) {
  const MeltControl& melt = scene.domain.melt;
  double least = std::numeric_limits<double>::infinity();
  for (const Group& m : scene.groups)
    for (const double t : temperatures_of(scene))
      if (m.kind == GroupKind::melt)
        least =
            std::min(least, m.viscosity * exact_exp(-melt.viscosity_fall * (t - melt.reference_temperature)));
  return least;
}

/// Beside the melt that differs most from grains of `density` [kg/m^3].
double largest_excess(const Scene& scene, double density) {
  const MeltControl& melt = scene.domain.melt;
  double most = 0;
  for (const Group& m : scene.groups)
    for (const double t : temperatures_of(scene))
      if (m.kind == GroupKind::melt)
        most = std::max(
            most, std::fabs(density - m.density * (1 - melt.expansion * (t - melt.reference_temperature))));
  return most;
}

}  // namespace

// A bed of the pressure p presses its grains together with about p d^2.
SuspensionNeed suspension_need(const Scene& scene, std::span<const std::int64_t> count) {
  SuspensionNeed need;
  const stokes::Grid grid = melt_grid(scene);
  const auto [least_edge, most_edge] = std::ranges::minmax(grid.edge);
  const double g = gravity_of(scene);
  double pressure = 0;
  const double thinnest = thinnest_melt(scene);
  const double largest = scene.largest_diameter();
  double smallest = largest;
  for (std::size_t k = 0; k < scene.groups.size(); ++k) {
    const Group& grains = scene.groups[k];
    if (grains.kind != GroupKind::grain || !(grains.grain.least_radius > 0)) continue;
    smallest = std::min(smallest, 2 * grains.grain.least_radius);
    const double r = grains.grain.largest_radius,
                 weight = largest_excess(scene, grains.density) * g * volume_of(r);
    pressure += static_cast<double>(count[k]) * weight / floor_area(scene);
    need.speed = std::max(need.speed, weight / scene.grains.drag.law->resistance({1, 0, 0, thinnest, 2 * r}));
  }
  need.cells_per_grain = {least_edge / largest, most_edge / smallest};
  // F / (k r) of a spring of constant stiffness, and of others at the overlap that they have then.
  const double force = pressure * largest * largest, radius = 0.5 * largest;
  for (int round = 0; round < 20; ++round) {
    const double overlap = std::clamp(need.overlap, 1e-9, scene.grains.contact.largest_overlap);
    need.overlap = force / (stiffest_contact(scene, radius, overlap) * radius);
  }
  const double stiffness =
      stiffest_contact(scene, radius, std::clamp(need.overlap, 1e-9, scene.grains.contact.largest_overlap));
  need.relaxation = scene.grains.drag.law->resistance({1, 0, 0, thinnest, smallest}) / (2 * stiffness);
  return need;
}

}  // namespace sph
