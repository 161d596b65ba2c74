#include "sph/scene/melt_grid.hpp"

namespace sph {

std::array<std::size_t, 2> melts_of(const Scene& scene) {
  std::array<std::size_t, 2> out{};
  bool any = false;
  for (std::size_t k = 0; k < scene.groups.size(); ++k) {
    if (scene.groups[k].kind != GroupKind::melt) continue;
    if (!any) out[0] = k;
    out[1] = k;
    any = true;
  }
  return out;
}

stokes::Grid melt_grid(const Scene& scene) {
  stokes::Grid grid;
  grid.dim = scene.dim;
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a) {
    const double length = scene.domain.upper[a] - scene.domain.lower[a];
    grid.cells[a] = scene.domain.melt.cells[a];
    grid.edge[a] = length / static_cast<double>(grid.cells[a]);
    grid.sides[a].fill(scene.domain.periodic[a] ? stokes::Side::periodic : stokes::Side::free_slip);
  }
  for (const MeltSide& side : scene.domain.melt.sides) {
    const auto face = static_cast<std::size_t>(side.side);
    if (!side.slip) grid.sides[face / 2][face % 2] = stokes::Side::no_slip;
  }
  return grid;
}

}  // namespace sph
