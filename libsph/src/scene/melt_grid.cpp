#include "sph/scene/melt_grid.hpp"

namespace sph {

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
