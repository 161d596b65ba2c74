#include "sph/output/cell_mesh.hpp"

#include <algorithm>

#include "sph/scene/melt_grid.hpp"
#include "sph/step/state.hpp"

namespace sph {

std::optional<CellMesh> cell_mesh(const State& state) {
  const Scene& scene = state.scene();
  if (!scene.has_melt() || state.particle_count() > scene.output.sort_limit) return std::nullopt;
  const stokes::Grid grid = melt_grid(scene);
  CellMesh mesh;
  mesh.cells = grid.cells;
  mesh.edge = grid.edge;
  std::copy_n(scene.domain.lower.begin(), scene.dim, mesh.origin.begin());
  for (std::size_t k = 0; k < state.sets().size(); ++k)
    (k == state.melt()->set() ? mesh.cell_fields : mesh.particle_fields) |= state.particles(k).fields();
  return mesh;
}

}  // namespace sph
