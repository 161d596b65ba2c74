#include "sph/start/placement.hpp"

#include <algorithm>
#include <cmath>

#include "scene/grain_fill.hpp"
#include "scene/lattice.hpp"
#include "scene/painting.hpp"
#include "start/initial_fields.hpp"
#include "start/placement_file.hpp"
#include "start/placement_tile.hpp"

namespace sph {
namespace {

void fill_with_grains(const Scene& scene, const GrainFill& fill, const PositionScale& scale,
                      Distribution& distribution, Particles& particles) {
  const InitialFields fields(scene);
  const decomp::Box own = distribution.own_cells();
  std::uint64_t id = first_id(scene, fill);
  decomp::Int3 k{};
  for (k[2] = 0; k[2] < points_of(fill, 2); ++k[2])
    for (k[1] = 0; k[1] < points_of(fill, 1); ++k[1])
      for (k[0] = 0; k[0] < points_of(fill, 0); ++k[0], ++id) {
        if (!is_occupied(scene, fill, id)) continue;
        NewParticle p{id, point(fill, k), {}, static_cast<std::uint32_t>(fill.group), 0, 0};
        displace(scene, fill.jitter * fill.spacing, p);
        decomp::Int3 q{};
        for (std::size_t a = 0; a < 3; ++a) q[a] = scale.quanta(p.position[a]);
        q = distribution.grid().wrap(q);
        if (!own.contains(distribution.grid().cell_of(q))) continue;
        p.radius = random_radius(scene, p);
        fields.set(p);
        append(scene, p, q, particles);
      }
}

}  // namespace

void place_particles(const Scene& scene, const PositionScale& scale, Distribution& distribution,
                     Particles& particles) {
  if (particles.has(Field::radius) && !scene.of_grains()) {
    for (const GrainFill& fill : scene.start.fills)
      fill_with_grains(scene, fill, scale, distribution, particles);
    return;
  }
  if (!scene.start.file.empty()) {
    place_particles_from_file(scene, scale, distribution, particles);
    return;
  }
  if (!scene.start.tile.file.empty()) {
    place_tiles(scene, scale, distribution, particles);
    return;
  }
  const Lattice lattice(scene);
  const InitialFields fields(scene);
  const std::size_t d = static_cast<std::size_t>(scene.dim);
  const decomp::CellGrid& grid = distribution.grid();
  const decomp::Box own = distribution.own_cells();

  decomp::Int3 lo{}, hi{1, 1, 1};
  for (std::size_t a = 0; a < d; ++a) {
    const int axis = static_cast<int>(a);
    const std::int64_t margin = 2 + static_cast<std::int64_t>(std::ceil(scene.start.lattice.jitter));
    const bool first_part = own.lo[a] == 0, last_part = own.hi[a] == grid.cells()[a];
    lo[a] = lattice.first(a);
    hi[a] = lattice.first(a) + lattice.count(a);
    if (!first_part || grid.periodic()[a])
      lo[a] = std::max(lo[a], lattice.below(a, scale.metres(grid.line(axis, own.lo[a]))) - margin);
    if (!last_part || grid.periodic()[a])
      hi[a] = std::min(hi[a], lattice.below(a, scale.metres(grid.line(axis, own.hi[a]))) + margin + 2);
    // A jittered particle may cross a periodic face.
    if (grid.periodic()[a] && scene.start.lattice.jitter > 0 && (first_part || last_part)) {
      lo[a] = lattice.first(a);
      hi[a] = lattice.first(a) + lattice.count(a);
    }
  }
  decomp::Int3 k{};
  for (k[2] = lo[2]; k[2] < hi[2]; ++k[2])
    for (k[1] = lo[1]; k[1] < hi[1]; ++k[1])
      for (k[0] = lo[0]; k[0] < hi[0]; ++k[0]) {
        const Double3 x = lattice.point(k);
        if (!lattice.inside(x)) continue;
        // A cell may hold two melts.
        const int group = scene.has_melt() ? static_cast<int>(melts_of(scene)[0]) : painted_group(scene, x);
        if (group < 0) continue;
        NewParticle p{lattice.id(k), x, {}, static_cast<std::uint32_t>(group), 0, 0};
        const Group& g = scene.groups[p.group];
        if (g.kind != GroupKind::wall && !g.grain.fixed)
          displace(scene, scene.start.lattice.jitter * scene.start.spacing, p);
        decomp::Int3 q{};
        for (std::size_t a = 0; a < d; ++a) q[a] = scale.quanta(p.position[a]);
        q = grid.wrap(q);
        if (!own.contains(grid.cell_of(q))) continue;
        if (g.kind == GroupKind::grain) p.radius = random_radius(scene, p);
        fields.set(p);
        append(scene, p, q, particles);
      }
}

}  // namespace sph
